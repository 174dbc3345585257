#include "gltf_writer/material_json.h"

#include <algorithm>

namespace froxel::gltf_writer {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";
constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";
constexpr const char* kIor = "KHR_materials_ior";
constexpr const char* kSpecular = "KHR_materials_specular";
constexpr const char* kClearcoat = "KHR_materials_clearcoat";
constexpr const char* kGlossiness = "KHR_materials_pbrSpecularGlossiness";

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

// What the dielectric part reflects, in members of their own.
void addSpecular(const scene::Material& m, Json& json, std::set<std::string>& extensions) {
    if (m.ior != 1.5F) {
        extensions.insert(kIor);
        json["extensions"][kIor] = {{"ior", m.ior}};
    }
    Json specular = Json::object();
    if (m.specular != 1) {
        specular["specularFactor"] = m.specular;
    }
    if (m.specular_color != glm::vec3(1)) {
        specular["specularColorFactor"] = colorJson(m.specular_color);
    }
    if (m.specular_texture.texture != scene::kNone) {
        specular["specularTexture"] = slotJson(m.specular_texture, extensions);
    }
    if (m.specular_color_texture.texture != scene::kNone) {
        specular["specularColorTexture"] = slotJson(m.specular_color_texture, extensions);
    }
    if (!specular.empty()) {
        extensions.insert(kSpecular);
        json["extensions"][kSpecular] = std::move(specular);
    }
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
    extensions.insert(kGlossiness);
    json["extensions"][kGlossiness] = std::move(glossiness);
}

void addCoat(const scene::Material& m, Json& json, std::set<std::string>& extensions) {
    if (m.coat == 0) {
        return; // there is nothing to see of the rest
    }
    Json coat = {{"clearcoatFactor", m.coat}, {"clearcoatRoughnessFactor", m.coat_roughness}};
    if (m.coat_texture.texture != scene::kNone) {
        coat["clearcoatTexture"] = slotJson(m.coat_texture, extensions);
    }
    if (m.coat_roughness_texture.texture != scene::kNone) {
        coat["clearcoatRoughnessTexture"] = slotJson(m.coat_roughness_texture, extensions);
    }
    if (m.coat_normal_texture.texture != scene::kNone) {
        coat["clearcoatNormalTexture"] = slotJson(m.coat_normal_texture, extensions);
        coat["clearcoatNormalTexture"]["scale"] = m.coat_normal_scale;
    }
    extensions.insert(kClearcoat);
    json["extensions"][kClearcoat] = std::move(coat);
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
        extensions.insert(kEmissiveStrength);
        json["extensions"][kEmissiveStrength] = {{"emissiveStrength", strength}};
    }
    if (m.unlit) {
        extensions.insert(kUnlit);
        json["extensions"][kUnlit] = Json::object();
    }
    if (m.glossiness_texture) {
        addGlossiness(m, json, extensions);
    } else {
        addSpecular(m, json, extensions);
    }
    addCoat(m, json, extensions);
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
