#include "render/scene/scene_needs.h"

#include "interface/constants.h"
#include "interface/gbuffer_io.h"
#include "render/scene/geometry_pack.h"

#include <algorithm>
#include <cmath>

namespace froxel::render {

namespace {

bool transformed(const scene::TextureSlot& slot) {
    return (slot.texcoord != 0 || slot.offset != glm::vec2(0, 0) || slot.rotation_rad != 0 ||
            slot.scale != glm::vec2(1, 1));
}

bool reflectsUnusually(const scene::Material& m) {
    return m.ior != 1.5F || m.specular != 1 || m.specular_color != glm::vec3(1) ||
           m.specular_texture.texture != scene::kNone ||
           m.specular_color_texture.texture != scene::kNone;
}

// Metal all over stops light.
bool transmits(const scene::Material& m) {
    const bool metal = m.metallic == 1 && m.metallic_roughness_texture.texture == scene::kNone;
    return m.transmission.strength != 0 && !metal;
}

// Whether what a texture says can be seen: nothing multiplied by it is 0.
bool shows(const scene::Material& m, uint32_t slot) {
    if (m.unlit) {
        return slot == io::base_color_slot;
    }
    switch (slot) {
    case io::emissive_slot:
        return m.emissive != glm::vec3(0);
    case io::coat_slot:
    case io::coat_normal_slot:
        return m.coat.strength != 0;
    case io::coat_roughness_slot:
        return m.coat.strength != 0 && m.coat.roughness != 0;
    case io::sheen_color_slot:
        return m.sheen.color != glm::vec3(0);
    case io::sheen_roughness_slot:
        return m.sheen.color != glm::vec3(0) && m.sheen.roughness != 0;
    case io::anisotropy_slot:
        return m.anisotropy.strength != 0;
    case io::film_slot:
        return m.film.strength != 0;
    case io::film_thickness_slot:
        return m.film.strength != 0 && m.film.least_nm != m.film.most_nm;
    case io::diffuse_transmission_slot:
    case io::diffuse_transmission_color_slot:
        return m.diffuse_transmission.strength != 0;
    case io::transmission_slot:
        return transmits(m);
    case io::thickness_slot:
        return m.volume.thickness_m != 0 &&
               (transmits(m) ||
                (m.diffuse_transmission.strength != 0 && m.volume.attenuation_m != 0));
    default:
        return true;
    }
}

MaterialFlags textureFlags(const scene::Material& m) {
    MaterialFlags flags = 0;
    const auto slots = textureSlots(m);
    for (uint32_t i = 0; i < slots.size(); ++i) {
        if (slots[i]->texture != scene::kNone && shows(m, i)) {
            flags |= textureFlag(i);
            flags |= transformed(*slots[i]) ? io::kMaterialUvTransform : 0U;
        }
    }
    return flags;
}

MaterialFlags materialFlags(const scene::Material& m) {
    MaterialFlags flags = textureFlags(m);
    const auto set = [&](bool condition, uint32_t flag) { flags |= condition ? flag : 0U; };
    set(m.alpha_mode == scene::AlphaMode::kMask, io::kMaterialMask);
    set(m.alpha_mode == scene::AlphaMode::kBlend, io::kMaterialBlend);
    set(m.double_sided, io::kMaterialDoubleSided);
    set(m.unlit, io::kMaterialUnlit);
    if (!m.unlit) {
        set(reflectsUnusually(m), io::kMaterialSpecular);
        set((flags & textureFlag(io::specular_color_slot)) != 0 && m.glossiness_texture,
            io::kMaterialGlossiness);
        set(m.coat.strength != 0, io::kMaterialCoat);
        set(m.sheen.color != glm::vec3(0), io::kMaterialSheen);
        set(m.anisotropy.strength != 0, io::kMaterialAnisotropy);
        set(m.film.strength != 0, io::kMaterialFilm);
        set(m.diffuse_transmission.strength != 0, io::kMaterialDiffuseTransmission);
        set(transmits(m), io::kMaterialTransmission);
        set(transmits(m) && m.volume.thickness_m != 0, io::kMaterialBody);
        set(transmits(m) && m.volume.thickness_m != 0 && m.transmission.dispersion != 0,
            io::kMaterialDispersion);
        set(transmits(m) && m.ior > 1 && (m.roughness != 0 || m.glossiness_texture),
            io::kMaterialFrosted);
    }
    return flags;
}

// Of a solid one.
bool needsWide(const scene::Material& m, bool metalness) {
    return (metalness && m.metallic != 0) || m.unlit || m.emissive != glm::vec3(0) ||
           m.occlusion_texture.texture != scene::kNone;
}

// The least that brings emission to io::kMostStoredEmission; of a solid one.
uint32_t emissionExponent(const scene::Material& m) {
    if (m.unlit) {
        return 0;
    }
    const float most = std::max({m.emissive.x, m.emissive.y, m.emissive.z});
    constexpr uint32_t kMost = 113; // of the largest float; infinity has no end
    uint32_t exponent = 0;
    while (exponent < kMost &&
           std::ldexp(most, -static_cast<int>(exponent)) > io::kMostStoredEmission) {
        ++exponent;
    }
    return exponent;
}

SurfaceNeeds surfaceNeeds(const scene::Material& m, MaterialFlags flags) {
    const bool solid = isSolid(flags);
    const bool unusual = !m.unlit && reflectsUnusually(m);
    const bool transmissive = isTransmissive(flags);
    return {.wide_gbuffer = solid && needsWide(m, true),
            .wide_lambert = solid && needsWide(m, false),
            .emission_exponent = solid ? emissionExponent(m) : 0,
            .specular = unusual && solid,
            .edges = (unusual && (m.specular != 1 || m.specular_texture.texture != scene::kNone)) ||
                     (flags & io::kMaterialFilm) != 0,
            .layers = (flags & io::kMaterialLayers) != 0 && solid,
            .masked = m.alpha_mode == scene::AlphaMode::kMask,
            .blended = !solid && !transmissive,
            .transmissive = transmissive,
            .unlit = m.unlit && solid};
}

} // namespace

void SurfaceNeeds::add(const SurfaceNeeds& other) {
    wide_gbuffer |= other.wide_gbuffer;
    wide_lambert |= other.wide_lambert;
    emission_exponent = std::max(emission_exponent, other.emission_exponent);
    specular |= other.specular;
    edges |= other.edges;
    layers |= other.layers;
    masked |= other.masked;
    blended |= other.blended;
    transmissive |= other.transmissive;
    unlit |= other.unlit;
}

SceneNeeds findNeeds(const scene::Scene& scene, bool layers) {
    SceneNeeds needs;
    for (const auto& material : scene.materials) {
        const MaterialFlags flags =
            materialFlags(material) & ~(layers ? MaterialFlags{0} : kLayerFlags);
        needs.material_flags.push_back(flags);
        needs.of_material.push_back(surfaceNeeds(material, flags));
        needs.add(needs.of_material.back());
    }
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            ++needs.primitive_count;
            needs.extended_count += isExtended(primitive) ? 1U : 0U;
        }
    }
    for (const auto& light : scene.lights) {
        needs.lights.points += light.type == scene::LightType::kPoint ? 1U : 0U;
        needs.lights.spots += light.type == scene::LightType::kSpot ? 1U : 0U;
        needs.lights.directionals += light.type == scene::LightType::kDirectional ? 1U : 0U;
    }
    return needs;
}

} // namespace froxel::render
