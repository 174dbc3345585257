#include "render/scene_needs.h"

#include "interface/constants.h"

#include <algorithm>

namespace froxel::render {

namespace {

bool transformed(const scene::TextureSlot& slot) {
    return slot.texture != scene::kNone &&
           (slot.texcoord != 0 || slot.offset != glm::vec2(0, 0) || slot.rotation_rad != 0 ||
            slot.scale != glm::vec2(1, 1));
}

uint32_t materialFlags(const scene::Material& m) {
    uint32_t flags = 0;
    const auto set = [&](bool condition, uint32_t flag) { flags |= condition ? flag : 0U; };
    set(m.base_color_texture.texture != scene::kNone, io::kMaterialBaseColorTexture);
    set(m.alpha_mode == scene::AlphaMode::kMask, io::kMaterialMask);
    set(m.alpha_mode == scene::AlphaMode::kBlend, io::kMaterialBlend);
    set(m.double_sided, io::kMaterialDoubleSided);
    set(m.unlit, io::kMaterialUnlit);
    set(transformed(m.base_color_texture), io::kMaterialUvTransform);
    if (m.unlit) {
        return flags;
    }
    set(m.normal_texture.texture != scene::kNone, io::kMaterialNormalTexture);
    set(m.metallic_roughness_texture.texture != scene::kNone, io::kMaterialRoughnessTexture);
    set(m.occlusion_texture.texture != scene::kNone, io::kMaterialOcclusionTexture);
    set(m.emissive_texture.texture != scene::kNone && m.emissive != glm::vec3(0),
        io::kMaterialEmissiveTexture);
    set(transformed(m.normal_texture) || transformed(m.metallic_roughness_texture) ||
            transformed(m.occlusion_texture) || transformed(m.emissive_texture),
        io::kMaterialUvTransform);
    return flags;
}

bool needsWide(const scene::Material& m) {
    return m.alpha_mode != scene::AlphaMode::kBlend &&
           (m.metallic != 0 || m.unlit || m.emissive != glm::vec3(0) ||
            m.occlusion_texture.texture != scene::kNone);
}

template <class Items, class Test>
size_t count(const Items& items, Test test) {
    return static_cast<size_t>(std::count_if(items.begin(), items.end(), test));
}

} // namespace

SceneNeeds findNeeds(const scene::Scene& scene) {
    SceneNeeds needs;
    for (const auto& material : scene.materials) {
        needs.material_flags.push_back(materialFlags(material));
        needs.wide_gbuffer |= needsWide(material);
        needs.masked |= material.alpha_mode == scene::AlphaMode::kMask;
        needs.blended |= material.alpha_mode == scene::AlphaMode::kBlend;
    }
    for (const auto& light : scene.lights) {
        needs.spots |= light.type == scene::LightType::kSpot;
        needs.directional |= light.type == scene::LightType::kDirectional;
    }
    return needs;
}

std::vector<std::string> explainNeeds(const scene::Scene& scene) {
    const SceneNeeds needs = findNeeds(scene);
    const auto line = [](const char* what, bool needed, const std::string& why) {
        return std::string(what) + (needed ? ": yes, " : ": no, ") + why;
    };
    const auto with = [&](uint32_t flag) {
        return std::to_string(
            count(needs.material_flags, [&](uint32_t f) { return (f & flag) != 0; }));
    };
    const auto lights = [&](scene::LightType type) {
        return std::to_string(count(scene.lights, [&](const auto& l) { return l.type == type; }));
    };
    return {
        line("transparent pass", needs.blended, with(io::kMaterialBlend) + " blended materials"),
        line("alpha test", needs.masked, with(io::kMaterialMask) + " masked materials"),
        line("normal mapping", with(io::kMaterialNormalTexture) != "0",
             with(io::kMaterialNormalTexture) + " materials with normal textures"),
        line("metallic-roughness textures", with(io::kMaterialRoughnessTexture) != "0",
             with(io::kMaterialRoughnessTexture) + " materials with one"),
        line("wide G-buffer (16 instead of 8 bytes a pixel)", needs.wide_gbuffer,
             needs.wide_gbuffer ? "metalness, occlusion, emission or unlit materials are present"
                                : "no metalness, occlusion, emission or unlit material"),
        line("spot light falloff", needs.spots, lights(scene::LightType::kSpot) + " spot lights"),
        line("directional lights", needs.directional,
             lights(scene::LightType::kDirectional) + " directional lights"),
    };
}

} // namespace froxel::render
