#include "scene/scene_check.h"

#include "core/finite.h"
#include "scene/motion_check.h"
#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace froxel::scene {

namespace {

using Fault = std::optional<std::string>;

std::string numbered(const char* what, size_t index) {
    return std::string(what) + " " + std::to_string(index);
}

template <class T>
Fault faultIn(const std::vector<T>& stream, const char* name, size_t count, bool optional) {
    if (stream.size() != count && !(optional && stream.empty())) {
        return std::string(name) + " has " + std::to_string(stream.size()) +
               " elements; expected one for each of " + std::to_string(count) + " positions";
    }
    for (size_t i = 0; i < stream.size(); ++i) {
        if (!isFinite(stream[i])) {
            return numbered(name, i) + " is not finite";
        }
    }
    return {};
}

Fault faultInMaterials(const Primitive& p, size_t material_count, size_t variant_count) {
    if (p.material >= material_count) {
        return "material is " + std::to_string(p.material) + "; there are " +
               std::to_string(material_count);
    }
    uint32_t least = 0;
    for (const VariantMaterial& of : p.variant_materials) {
        if (of.material >= material_count || of.variant < least || of.variant >= variant_count) {
            return "variant " + std::to_string(of.variant) + " has material " +
                   std::to_string(of.material) + "; there are " + std::to_string(variant_count) +
                   " variants, which ascend, and " + std::to_string(material_count) + " materials";
        }
        least = of.variant + 1;
    }
    return {};
}

Fault faultIn(const Primitive& p) {
    const size_t count = p.positions.size();
    for (Fault fault :
         {faultIn(p.positions, "positions", count, false),
          faultIn(p.normals, "normals", count, false), faultIn(p.tangents, "tangents", count, true),
          faultIn(p.uv0, "uv0", count, true), faultIn(p.uv1, "uv1", count, true),
          faultIn(p.colors, "colors", count, true)}) {
        if (fault) {
            return fault;
        }
    }
    if (p.indices.size() % 3 != 0) {
        return "indices are " + std::to_string(p.indices.size()) + "; expected three a triangle";
    }
    for (size_t i = 0; i < p.indices.size(); ++i) {
        if (p.indices[i] >= count) {
            return numbered("indices", i) + " is " + std::to_string(p.indices[i]) + "; there are " +
                   std::to_string(count) + " positions";
        }
    }
    return {};
}

Fault faultIn(const TextureSlot& slot, const char* name, const Scene& scene) {
    if (slot.texture == kNone) {
        return {};
    }
    const std::string of = std::string(name) + " ";
    if (slot.texture >= scene.textures.size()) {
        return of + "texture is " + std::to_string(slot.texture) + "; there are " +
               std::to_string(scene.textures.size());
    }
    const Texture& texture = scene.textures[slot.texture];
    if (texture.image >= scene.images.size() ||
        (texture.sampler != kNone && texture.sampler >= scene.samplers.size())) {
        return of + "texture names an image or a sampler that is not there";
    }
    if (slot.texcoord > 1) {
        return of + "texcoord is " + std::to_string(slot.texcoord) + "; expected 0 or 1";
    }
    if (!isFinite(slot.offset)) {
        return of + "offset is not finite";
    }
    if (!isFinite(slot.rotation_rad)) {
        return of + "rotation_rad is not finite";
    }
    return isFinite(slot.scale) ? Fault() : of + "scale is not finite";
}

// Of a row of interface/material_factors.h, which consists of floats.
template <class Factors>
bool areFinite(const Factors& factors) {
    const auto numbers = std::bit_cast<std::array<float, sizeof(Factors) / sizeof(float)>>(factors);
    return std::ranges::all_of(numbers, [](float number) { return isFinite(number); });
}

Fault faultIn(const Material& m, const Scene& scene) {
    const std::pair<const char*, bool> factors[] = {
        {"base_color", isFinite(m.base_color)},
        {"metallic", isFinite(m.metallic)},
        {"roughness", isFinite(m.roughness)},
        {"normal_scale", isFinite(m.normal_scale)},
        {"occlusion_strength", isFinite(m.occlusion_strength)},
        {"emissive", isFinite(m.emissive)},
        {"alpha_cutoff", isFinite(m.alpha_cutoff)},
        {"ior", isFinite(m.ior)},
        {"specular", isFinite(m.specular)},
        {"specular_color", isFinite(m.specular_color)},
#define FROXEL_FACTORS(type, name) {#name, areFinite(m.name)},
        FROXEL_MATERIAL_FACTORS(FROXEL_FACTORS)
#undef FROXEL_FACTORS
    };
    for (const auto& [name, right] : factors) {
        if (!right) {
            return std::string(name) + " is not finite";
        }
    }
    const auto slots = textureSlots(m);
    for (size_t i = 0; i < slots.size(); ++i) {
        if (Fault fault = faultIn(*slots[i], kSlotRows[i].name, scene)) {
            return fault;
        }
    }
    return {};
}

Fault faultIn(const Instance& instance, size_t mesh_count) {
    if (instance.mesh >= mesh_count) {
        return "mesh is " + std::to_string(instance.mesh) + "; there are " +
               std::to_string(mesh_count);
    }
    if (!isUsable(instance.world_from_object)) {
        return "world_from_object has an element that is not finite or beyond 1e15";
    }
    return {};
}

} // namespace

Fault findFault(const Scene& scene) {
    const auto named = [&](const std::string& where, const std::string& fault) {
        return "the scene's " + where + ": " + fault;
    };
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        if (const Fault fault = faultIn(scene.materials[i], scene)) {
            return named(numbered("material", i), *fault);
        }
    }
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        for (size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
            const Primitive& primitive = scene.meshes[m].primitives[p];
            Fault fault = faultIn(primitive);
            if (!fault) {
                fault = faultInMaterials(primitive, scene.materials.size(),
                                         scene.material_variants.size());
            }
            if (fault) {
                return named(numbered("mesh", m) + numbered(" primitive", p), *fault);
            }
        }
    }
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        if (const Fault fault = faultIn(scene.instances[i], scene.meshes.size())) {
            return named(numbered("instance", i), *fault);
        }
    }
    return scene.motion ? findMotionFault(scene) : Fault();
}

} // namespace froxel::scene
