#include "gltf/material_reader.h"

#include "core/text.h"
#include "gltf/extension_value.h"
#include "gltf/uri.h"
#include "gltf/word_table.h"

#include <algorithm>
#include <utility>

namespace froxel::gltf {
namespace {

std::optional<scene::Wrap> wrapFrom(int value) {
    switch (value) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return scene::Wrap::kRepeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return scene::Wrap::kMirroredRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return scene::Wrap::kClampToEdge;
    default:
        return std::nullopt;
    }
}

// False for what glTF does not know.
bool setMinFilter(scene::Sampler& sampler, int value) {
    using scene::Filter;
    switch (value) {
    case -1:
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
        return true;
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
        sampler.mipmapped = false;
        sampler.mip = Filter::kNearest;
        break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        sampler.mip = Filter::kNearest;
        break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
        break;
    default:
        return false;
    }
    const bool nearest = value == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                         value == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                         value == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    sampler.min = nearest ? Filter::kNearest : Filter::kLinear;
    return true;
}

// A pair of KHR_texture_transform.
glm::vec2 pairOr(const tinygltf::Value& object, const char* key, const glm::vec2& fallback) {
    if (!object.Has(key) || !object.Get(key).IsArray()) {
        return fallback;
    }
    const tinygltf::Value& value = object.Get(key);
    return {glm::dvec2(value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble())};
}

} // namespace

float MaterialReader::unit(double value, const char* factor, const std::string& name) {
    const double clamped = std::clamp(value, 0.0, 1.0);
    if (clamped != value) {
        warnings_.add(warning::kFactorRange, pointer_,
                      name + " has the " + factor + " " + numberText(value) + "; " +
                          numberText(clamped) + " is used; expected 0 to 1");
    }
    return static_cast<float>(clamped);
}

float MaterialReader::inRange(double value,
                              const MaterialFactor& factor,
                              float usual,
                              const std::string& name) {
    const auto tell = [&](const std::string& used, const char* right) {
        warnings_.add(warning::kFactorRange, pointer_,
                      name + " has the " + factor.key + " " + numberText(value) + "; " + used +
                          " is used; expected " + right);
    };
    switch (factor.range) {
    case FactorRange::kUnit:
        return unit(value, factor.key, name);
    case FactorRange::kFromZero:
        if (value < 0) {
            tell("0", "0 or more");
        }
        return static_cast<float>(std::max(value, 0.0));
    case FactorRange::kFromOne:
        if (value < 1) {
            tell("1", "1 or more");
        }
        return static_cast<float>(std::max(value, 1.0));
    case FactorRange::kAny:
        return static_cast<float>(value);
    case FactorRange::kIor:
        break;
    }
    if (value == 0 || value >= 1) {
        return static_cast<float>(value);
    }
    tell(numberText(usual), "0 or at least 1");
    return usual;
}

double MaterialReader::numberIn(const tinygltf::Value& object,
                                const char* key,
                                double fallback,
                                const std::string& name) {
    if (object.Has(key) && !object.Get(key).IsNumber()) {
        warnings_.add(warning::kType, pointer_,
                      name + " has a " + key + " that is not used; expected a number");
        return fallback;
    }
    return numberOr(object, key, fallback);
}

std::vector<double> MaterialReader::factorsIn(const tinygltf::Value& object,
                                              const char* key,
                                              const std::vector<double>& fallback,
                                              const std::string& name) {
    if (!object.Has(key)) {
        return fallback;
    }
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsArray()) {
        warnings_.add(warning::kType, pointer_,
                      name + " has a " + key + " that is not used; expected an array of " +
                          std::to_string(fallback.size()) + " numbers");
        return fallback;
    }
    std::vector<double> factors;
    for (const tinygltf::Value& factor : value.Get<tinygltf::Value::Array>()) {
        factors.push_back(factor.GetNumberAsDouble());
    }
    return factors;
}

std::optional<size_t>
MaterialReader::existing(int index, size_t size, const char* kind, const std::string& user) {
    if (index >= 0 && static_cast<size_t>(index) < size) {
        return static_cast<size_t>(index);
    }
    warnings_.add(warning::kUnresolved, pointer_,
                  user + " uses " + kind + " " + std::to_string(index) +
                      ", which it goes without; " + "the file has " + std::to_string(size) +
                      ", counted from 0");
    return std::nullopt;
}

scene::AlphaMode MaterialReader::alphaModeFrom(const std::string& text, const std::string& name) {
    constexpr std::pair<const char*, scene::AlphaMode> kModes[] = {
        {"OPAQUE", scene::AlphaMode::kOpaque},
        {"MASK", scene::AlphaMode::kMask},
        {"BLEND", scene::AlphaMode::kBlend}};
    const auto mode = named(kModes, text);
    if (!mode) {
        warnings_.add(warning::kUnknownName, pointer_,
                      name + " has alphaMode '" + printable(text, 40) +
                          "'; OPAQUE is used; expected OPAQUE, MASK or BLEND");
    }
    return mode.value_or(scene::AlphaMode::kOpaque);
}

uint32_t MaterialReader::material(int index, const std::string& pointer, const std::string& user) {
    if (index >= 0) {
        pointer_ = pointer;
        index = existing(index, document_.model.materials.size(), "material", user) ? index : -1;
    }
    const auto known = known_materials_.find(index);
    if (known != known_materials_.end()) {
        return known->second;
    }
    scene::Material material;
    material.name = "default";
    if (index >= 0) {
        pointer_ = pointerTo("materials", static_cast<size_t>(index));
        material = read(document_.model.materials[static_cast<size_t>(index)],
                        thing("material", static_cast<size_t>(index)));
    }
    const auto position = static_cast<uint32_t>(scene_.materials.size());
    auto set = texcoord_sets_[position].begin();
    for (scene::TextureSlot* slot : textureSlots(material)) {
        *set++ = std::exchange(slot->texcoord, std::min(slot->texcoord, 1U));
    }
    scene_.materials.push_back(std::move(material));
    known_materials_.emplace(index, position);
    return position;
}

std::vector<uint32_t> MaterialReader::texcoordSets(uint32_t material) const {
    std::vector<uint32_t> read;
    auto set = texcoord_sets_.at(material).begin();
    for (const scene::TextureSlot* slot : textureSlots(scene_.materials[material])) {
        if (slot->texture != scene::kNone && std::ranges::find(read, *set) == read.end()) {
            read.push_back(*set);
        }
        ++set;
    }
    return read;
}

uint32_t MaterialReader::withTexcoords(uint32_t material,
                                       const TexcoordPlaces& places,
                                       const std::string& pointer,
                                       const std::string& user) {
    const auto& sets = texcoord_sets_.at(material);
    const auto slots = textureSlots(scene_.materials[material]);
    size_t left_out = 0;
    bool moved = false;
    for (size_t i = 0; i < slots.size(); ++i) {
        const auto place = places.find(sets[i]);
        if (slots[i]->texture != scene::kNone && place == places.end()) {
            ++left_out;
        } else if (slots[i]->texture != scene::kNone) {
            moved |= place->second != slots[i]->texcoord;
        }
    }
    if (left_out > 0) {
        warnings_.add(warning::kNoTexcoord, pointer,
                      user + " has no texture coordinates for " + std::to_string(left_out) +
                          " textures of its material, which are left out");
    }
    if (left_out == 0 && !moved) {
        return material;
    }
    const auto position = static_cast<uint32_t>(scene_.materials.size());
    const auto [known, is_new] = with_texcoords_.try_emplace({material, places}, position);
    if (is_new) {
        scene::Material changed = scene_.materials[material];
        const auto own = textureSlots(changed);
        for (size_t i = 0; i < own.size(); ++i) {
            const auto place = places.find(sets[i]);
            if (own[i]->texture != scene::kNone && place == places.end()) {
                clearTexture(changed, *own[i]);
            } else if (own[i]->texture != scene::kNone) {
                own[i]->texcoord = place->second;
            }
        }
        scene_.materials.push_back(std::move(changed));
    }
    return known->second;
}

scene::Material MaterialReader::read(const tinygltf::Material& source, const std::string& name) {
    scene::Material material;
    material.name = source.name;
    material.unlit = findExtension(source.extensions, kUnlit) != nullptr;
    const auto* glossiness = findExtension(source.extensions, kGlossiness);
    if (glossiness != nullptr && !material.unlit) {
        readGlossiness(*glossiness, name, material);
    } else {
        readMetallicRoughness(source, name, material);
    }
    for (const MaterialExtension& row : materialExtensions()) {
        const auto* object = findExtension(source.extensions, row.name);
        if (object != nullptr && !material.unlit && !(row.of_dielectric && glossiness != nullptr)) {
            readExtension(row, *object, name, material);
        }
    }
    material.normal_scale = static_cast<float>(source.normalTexture.scale);
    material.occlusion_strength = unit(source.occlusionTexture.strength, "strength", name);
    double strength = 1;
    if (const auto* ext = findExtension(source.extensions, kEmissiveStrength)) {
        strength = numberOr(*ext, "emissiveStrength", 1);
        if (strength < 0) {
            warnings_.add(warning::kFactorRange, pointer_,
                          name + " has emissiveStrength " + numberText(strength) +
                              "; 0 is used; expected 0 or more");
            strength = 0;
        }
    }
    for (size_t i = 0; i < source.emissiveFactor.size() && i < 3; ++i) {
        const float factor = unit(source.emissiveFactor[i], "emissiveFactor", name);
        material.emissive[static_cast<int>(i)] =
            static_cast<float>(static_cast<double>(factor) * strength);
    }
    material.alpha_mode = alphaModeFrom(source.alphaMode, name);
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
    material.double_sided = source.doubleSided;
    material.normal_texture = slot(source.normalTexture, name + " normalTexture");
    material.occlusion_texture = slot(source.occlusionTexture, name + " occlusionTexture");
    material.emissive_texture = slot(source.emissiveTexture, name + " emissiveTexture");
    return material;
}

void MaterialReader::readMetallicRoughness(const tinygltf::Material& source,
                                           const std::string& name,
                                           scene::Material& material) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    for (int i = 0; i < 4; ++i) {
        material.base_color[i] =
            unit(pbr.baseColorFactor[static_cast<size_t>(i)], "baseColorFactor", name);
    }
    material.metallic = unit(pbr.metallicFactor, "metallicFactor", name);
    material.roughness = unit(pbr.roughnessFactor, "roughnessFactor", name);
    material.base_color_texture = slot(pbr.baseColorTexture, name + " baseColorTexture");
    material.metallic_roughness_texture =
        slot(pbr.metallicRoughnessTexture, name + " metallicRoughnessTexture");
}

// KHR_materials_pbrSpecularGlossiness, in place of metalness and roughness: a dielectric that would
// reflect everything, times its specular colour.
void MaterialReader::readGlossiness(const tinygltf::Value& extension,
                                    const std::string& name,
                                    scene::Material& material) {
    const auto diffuse = factorsIn(extension, "diffuseFactor", {1, 1, 1, 1}, name);
    const auto specular = factorsIn(extension, "specularFactor", {1, 1, 1}, name);
    for (size_t i = 0; i < diffuse.size(); ++i) {
        material.base_color[static_cast<int>(i)] = unit(diffuse[i], "diffuseFactor", name);
    }
    for (size_t i = 0; i < specular.size(); ++i) {
        material.specular_color[static_cast<int>(i)] = unit(specular[i], "specularFactor", name);
    }
    material.base_color_texture = slotIn(extension, "diffuseTexture", name);
    material.metallic = 0;
    material.roughness =
        1 - unit(numberOr(extension, "glossinessFactor", 1), "glossinessFactor", name);
    material.ior = 0;
    material.specular_color_texture = slotIn(extension, "specularGlossinessTexture", name);
    material.glossiness_texture = material.specular_color_texture.texture != scene::kNone;
}

void MaterialReader::readExtension(const MaterialExtension& row,
                                   const tinygltf::Value& object,
                                   const std::string& name,
                                   scene::Material& material) {
    for (const MaterialFactor& factor : row.factors) {
        const std::span<float> numbers = factor.of(material);
        std::vector<double> values(numbers.begin(), numbers.end());
        if (values.size() == 1) {
            values[0] = numberIn(object, factor.key, values[0], name);
        } else {
            values = factorsIn(object, factor.key, values, name);
        }
        for (size_t i = 0; i < values.size(); ++i) {
            numbers[i] = inRange(values[i], factor, numbers[i], name);
        }
    }
    for (const MaterialTexture& texture : row.textures) {
        *textureSlots(material)[texture.slot] = slotIn(object, texture.key, name);
        if (texture.scale != nullptr && object.Has(texture.key) &&
            object.Get(texture.key).Has("scale")) {
            texture.scale(material) =
                static_cast<float>(numberIn(object.Get(texture.key), "scale", 1, name));
        }
    }
}

scene::TextureSlot
MaterialReader::slotIn(const tinygltf::Value& extension, const char* key, const std::string& name) {
    if (!extension.Has(key)) {
        return {};
    }
    const tinygltf::Value& value = extension.Get(key);
    tinygltf::TextureInfo info;
    info.index = intOr(value, "index", -1);
    info.texCoord = intOr(value, "texCoord", 0);
    if (value.Has("extensions")) {
        const tinygltf::Value& extensions = value.Get("extensions");
        for (const std::string& extension_name : extensions.Keys()) {
            info.extensions[extension_name] = extensions.Get(extension_name);
        }
    }
    return slot(info, name + " " + key);
}

template <class Info>
scene::TextureSlot MaterialReader::slot(const Info& info, const std::string& user) {
    scene::TextureSlot slot;
    if (info.index < 0) {
        return slot;
    }
    const auto index = existing(info.index, document_.model.textures.size(), "texture", user);
    if (!index) {
        return slot;
    }
    int texcoord = info.texCoord;
    if (const auto* transform = findExtension(info.extensions, "KHR_texture_transform")) {
        slot.offset = pairOr(*transform, "offset", slot.offset);
        slot.scale = pairOr(*transform, "scale", slot.scale);
        slot.rotation_rad = static_cast<float>(numberIn(*transform, "rotation", 0, user));
        texcoord = intOr(*transform, "texCoord", texcoord);
    }
    slot.texcoord = static_cast<uint32_t>(texcoord);
    slot.texture = texture(*index, user);
    return slot;
}

uint32_t MaterialReader::texture(size_t index, const std::string& user) {
    const auto known = known_textures_.find(index);
    if (known != known_textures_.end()) {
        return known->second;
    }
    const tinygltf::Texture& source = document_.model.textures[index];
    const std::string name = thing("texture", index);
    std::vector<size_t> sources; // the best first
    const auto add = [&](int image) {
        if (image >= 0) {
            if (const auto number = existing(image, document_.images.size(), "image", name)) {
                sources.push_back(*number);
            }
        }
    };
    for (const char* better : {"KHR_texture_basisu", "EXT_texture_webp"}) {
        if (const auto* extension = findExtension(source.extensions, better)) {
            add(intOr(*extension, "source", -1));
        }
    }
    add(source.source);
    if (sources.empty()) {
        warnings_.add(warning::kNoSource, pointerTo("textures", index),
                      user + " is ignored: " + name +
                          " has no image in a supported format (PNG, JPEG, WebP, KTX2)");
        return known_textures_.emplace(index, scene::kNone).first->second;
    }
    scene::Texture texture;
    texture.image = image(sources);
    texture.sampler = source.sampler < 0 ? scene::kNone : sampler(source.sampler, name);
    const auto position = static_cast<uint32_t>(scene_.textures.size());
    scene_.textures.push_back(texture);
    known_textures_.emplace(index, position);
    return position;
}

uint32_t MaterialReader::sampler(int index, const std::string& user) {
    const auto& all = document_.model.samplers;
    const auto number = existing(index, all.size(), "sampler", user);
    if (!number) {
        return scene::kNone;
    }
    const auto found = known_samplers_.find(index);
    if (found != known_samplers_.end()) {
        return found->second;
    }
    const tinygltf::Sampler& source = all[*number];
    const std::string name = thing("sampler", *number);
    const auto tell = [&](const char* property, int value, const char* consequence) {
        warnings_.add(warning::kSamplerValue, pointerTo("samplers", *number) + "/" + property,
                      name + " has " + property + " " + std::to_string(value) + "; " + consequence);
    };
    const auto wrap = [&](const char* property, int value) {
        const auto known_wrap = wrapFrom(value);
        if (!known_wrap) {
            tell(property, value, "it repeats; expected 10497, 33648 or 33071");
        }
        return known_wrap.value_or(scene::Wrap::kRepeat);
    };
    scene::Sampler sampler;
    sampler.wrap_u = wrap("wrapS", source.wrapS);
    sampler.wrap_v = wrap("wrapT", source.wrapT);
    if (source.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) {
        sampler.mag = scene::Filter::kNearest;
    } else if (source.magFilter != -1 && source.magFilter != TINYGLTF_TEXTURE_FILTER_LINEAR) {
        tell("magFilter", source.magFilter, "it is linear; expected 9728 or 9729");
    }
    if (!setMinFilter(sampler, source.minFilter)) {
        tell("minFilter", source.minFilter,
             "it is linear with mipmaps; expected 9728, 9729 or 9984 to 9987");
    }
    const auto position = static_cast<uint32_t>(scene_.samplers.size());
    scene_.samplers.push_back(sampler);
    known_samplers_.emplace(index, position);
    return position;
}

uint32_t MaterialReader::image(const std::vector<size_t>& sources) {
    const auto position = static_cast<uint32_t>(scene_.images.size());
    const auto [known, is_new] = known_images_.emplace(sources, position);
    if (is_new) {
        scene::Image image;
        const ImageSource& source = document_.images[sources.front()];
        image.name = !source.name.empty() || isDataUri(source.uri) ? source.name : source.uri;
        scene_.images.push_back(std::move(image));
        images_.push_back(sources);
    }
    return known->second;
}

} // namespace froxel::gltf
