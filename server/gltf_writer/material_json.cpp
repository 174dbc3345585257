#include "gltf_writer/material_json.h"

#include "gltf/material_extensions.h"

#include <algorithm>
#include <span>

namespace froxel::gltf_writer {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";

Json slotJson(const scene::TextureSlot& slot, std::set<std::string>& extensions) {
    Json json = {{"index", slot.texture}};
    if (slot.texcoord != 0) {
        json["texCoord"] = slot.texcoord;
    }
    Json transform = Json::object();
    if (slot.offset != glm::vec2(0)) {
        transform["offset"] = {slot.offset.x, slot.offset.y};
    }
    if (slot.rotation_rad != 0) {
        transform["rotation"] = slot.rotation_rad;
    }
    if (slot.scale != glm::vec2(1)) {
        transform["scale"] = {slot.scale.x, slot.scale.y};
    }
    if (!transform.empty()) {
        extensions.insert(kTransform);
        json["extensions"][kTransform] = std::move(transform);
    }
    return json;
}

Json pbrJson(const scene::Material& m, std::set<std::string>& extensions) {
    Json pbr = {
        {"baseColorFactor", {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w}},
        {"metallicFactor", m.metallic},
        {"roughnessFactor", m.roughness}};
    if (m.base_color_texture.texture != scene::kNone) {
        pbr["baseColorTexture"] = slotJson(m.base_color_texture, extensions);
    }
    if (m.metallic_roughness_texture.texture != scene::kNone) {
        pbr["metallicRoughnessTexture"] = slotJson(m.metallic_roughness_texture, extensions);
    }
    return pbr;
}

Json colorJson(const glm::vec3& color) {
    return {color.x, color.y, color.z};
}

// A material whose roughness is in its specular colour's texture: no other extension has that.
void addGlossiness(const scene::Material& m, Json& json, std::set<std::string>& extensions) {
    Json glossiness = {
        {"diffuseFactor", {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w}},
        {"specularFactor", colorJson(m.specular_color)},
        {"glossinessFactor", 1 - m.roughness},
        {"specularGlossinessTexture", slotJson(m.specular_color_texture, extensions)}};
    if (m.base_color_texture.texture != scene::kNone) {
        glossiness["diffuseTexture"] = slotJson(m.base_color_texture, extensions);
    }
    extensions.insert(gltf::kGlossiness);
    json["extensions"][gltf::kGlossiness] = std::move(glossiness);
}

Json numbersJson(std::span<const float> numbers) {
    return numbers.size() == 1 ? Json(numbers[0]) : Json(numbers);
}

// What is not as usual of a row of factors and textures.
void addExtension(const gltf::MaterialExtension& row,
                  scene::Material m,
                  Json& json,
                  std::set<std::string>& extensions) {
    if (row.present != nullptr && !row.present(m)) {
        return; // there is nothing to see of the rest
    }
    Json object = Json::object();
    scene::Material usual;
    for (const gltf::MaterialFactor& factor : row.factors) {
        const std::span<float> numbers = factor.of(m);
        if (factor.always || !std::ranges::equal(numbers, factor.of(usual))) {
            object[factor.key] = numbersJson(numbers);
        }
    }
    for (const gltf::MaterialTexture& texture : row.textures) {
        const scene::TextureSlot& slot = *textureSlots(m)[texture.slot];
        if (slot.texture != scene::kNone) {
            object[texture.key] = slotJson(slot, extensions);
            if (texture.scale != nullptr) {
                object[texture.key]["scale"] = texture.scale(m);
            }
        }
    }
    if (!object.empty()) {
        extensions.insert(row.name);
        json["extensions"][row.name] = std::move(object);
    }
}

int wrapCode(scene::Wrap wrap) {
    switch (wrap) {
    case scene::Wrap::kMirroredRepeat:
        return 33648;
    case scene::Wrap::kClampToEdge:
        return 33071;
    case scene::Wrap::kRepeat:
        break;
    }
    return 10497;
}

int minFilterCode(const scene::Sampler& sampler) {
    const int linear = sampler.min == scene::Filter::kLinear ? 1 : 0;
    if (!sampler.mipmapped) {
        return 9728 + linear;
    }
    return 9984 + linear + (sampler.mip == scene::Filter::kLinear ? 2 : 0);
}

} // namespace

Json materialJson(const scene::Material& m, std::set<std::string>& extensions) {
    Json json = Json::object();
    if (!m.name.empty()) {
        json["name"] = m.name;
    }
    json["pbrMetallicRoughness"] = pbrJson(m, extensions);
    if (m.normal_texture.texture != scene::kNone) {
        json["normalTexture"] = slotJson(m.normal_texture, extensions);
        json["normalTexture"]["scale"] = m.normal_scale;
    }
    if (m.occlusion_texture.texture != scene::kNone) {
        json["occlusionTexture"] = slotJson(m.occlusion_texture, extensions);
        json["occlusionTexture"]["strength"] = m.occlusion_strength;
    }
    if (m.emissive_texture.texture != scene::kNone) {
        json["emissiveTexture"] = slotJson(m.emissive_texture, extensions);
    }
    // The factor ends at 1; what is brighter goes to the strength.
    const float strength = std::max({1.0F, m.emissive.x, m.emissive.y, m.emissive.z});
    const glm::vec3 factor = m.emissive / strength;
    if (factor != glm::vec3(0)) {
        json["emissiveFactor"] = {factor.x, factor.y, factor.z};
    }
    if (strength > 1.0F) {
        extensions.insert(gltf::kEmissiveStrength);
        json["extensions"][gltf::kEmissiveStrength] = {{"emissiveStrength", strength}};
    }
    if (m.unlit) {
        extensions.insert(gltf::kUnlit);
        json["extensions"][gltf::kUnlit] = Json::object();
    }
    if (m.glossiness_texture) {
        addGlossiness(m, json, extensions);
    }
    for (const gltf::MaterialExtension& row : gltf::materialExtensions()) {
        if (!(row.of_dielectric && m.glossiness_texture)) {
            addExtension(row, m, json, extensions);
        }
    }
    if (m.alpha_mode == scene::AlphaMode::kMask) {
        json["alphaMode"] = "MASK";
        json["alphaCutoff"] = m.alpha_cutoff;
    } else if (m.alpha_mode == scene::AlphaMode::kBlend) {
        json["alphaMode"] = "BLEND";
    }
    if (m.double_sided) {
        json["doubleSided"] = true;
    }
    return json;
}

Json samplerJson(const scene::Sampler& sampler) {
    return {{"magFilter", sampler.mag == scene::Filter::kLinear ? 9729 : 9728},
            {"minFilter", minFilterCode(sampler)},
            {"wrapS", wrapCode(sampler.wrap_u)},
            {"wrapT", wrapCode(sampler.wrap_v)}};
}

Json textureJson(const scene::Texture& texture) {
    Json json = {{"source", texture.image}};
    if (texture.sampler != scene::kNone) {
        json["sampler"] = texture.sampler;
    }
    return json;
}

} // namespace froxel::gltf_writer
