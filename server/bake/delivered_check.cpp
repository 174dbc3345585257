#include "bake/delivered_check.h"

#include "core/finite.h"
#include "core/text.h"
#include "gltf/image_decode.h"
#include "gltf/limits.h"
#include "scene/motion.h"
#include "scene/scene_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace froxel::bake {

namespace {

using Fault = std::optional<std::string>;

constexpr double kFarthest_m = 1e16; // beyond scene::kLargestElement in any direction

template <class Vector>
bool isNear(const Vector& v) {
    for (int i = 0; i < v.length(); ++i) {
        if (!(std::abs(v[i]) <= kFarthest_m)) {
            return false;
        }
    }
    return true;
}

bool isShort(const std::string& text, size_t most_bytes) {
    return text.size() <= most_bytes;
}

Fault faultIn(const scene::Image& image) {
    const gltf::ImageSize size{image.width_px, image.height_px};
    const uint32_t most = gltf::kMaxImageSide_px;
    if (size.width_px == 0 || size.height_px == 0 || size.width_px > most ||
        size.height_px > most || image.rgba8.size() != size.levelBytes(0)) {
        return "its bytes are not those of its size";
    }
    if (image.mips.size() >=
        static_cast<size_t>(std::bit_width(std::max(size.width_px, size.height_px)))) {
        return "it has levels below a pixel";
    }
    for (uint32_t level = 1; level <= image.mips.size(); ++level) {
        if (image.mips[level - 1].size() != size.levelBytes(level)) {
            return "a level's bytes are not those of its size";
        }
    }
    return {};
}

Fault faultIn(const scene::Mesh& mesh) {
    for (const scene::Primitive& primitive : mesh.primitives) {
        Bounds3 bounds;
        for (const glm::vec3& position : primitive.positions) {
            bounds.add(position);
        }
        if (bounds != primitive.bounds) {
            return "its bounds are not those of its positions";
        }
    }
    return {};
}

Fault faultIn(const scene::NamedCamera& named) {
    const settings::Camera& c = named.camera;
    const auto axes = {c.world_from_view[0], c.world_from_view[1], c.world_from_view[2]};
    const bool unit = std::ranges::all_of(
        axes, [](const glm::dvec3& axis) { return std::abs(glm::length(axis) - 1) < 1e-3; });
    const bool right = isNear(c.eye_world) && unit && c.yfov_rad > 0 &&
                       c.yfov_rad < std::numbers::pi && c.half_height_m > 0 &&
                       c.half_height_m <= kFarthest_m && isNear(c.lens_shift) && c.near_m > 0 &&
                       c.near_m <= kFarthest_m && c.focus_m > 0 && c.focus_m <= kFarthest_m;
    return right ? Fault() : "it is not a camera's place, axes and angles";
}

Fault faultIn(const scene::PunctualLight& light) {
    const bool right =
        isNear(light.position_world) && std::abs(glm::length(light.direction_world) - 1) < 1e-3 &&
        isFinite(light.color) && isFinite(light.intensity) && light.range_m >= 0 &&
        isFinite(light.range_m) && light.inner_cone_rad >= 0 &&
        light.inner_cone_rad <= light.outer_cone_rad && light.outer_cone_rad <= std::numbers::pi;
    return right && !light.rectangle ? Fault() : "it is not a light's place, colour and cone";
}

Fault faultIn(const scene::Warning& warning) {
    const bool right = isShort(warning.code, 128) && isShort(warning.pointer, 4096) &&
                       isShort(warning.message, 4096) &&
                       warning.code == printable(warning.code, 128) &&
                       warning.message == printable(warning.message, 4096);
    return right ? Fault() : "it is no printable line";
}

template <class Things>
Fault faultInEach(const Things& things, const char* name) {
    for (size_t i = 0; i < things.size(); ++i) {
        if (const Fault fault = faultIn(things[i])) {
            return std::string(name) + " " + std::to_string(i) + ": " + *fault;
        }
    }
    return {};
}

// Every viewer is sent these names.
bool namesAreShort(const scene::Scene& scene) {
    const auto fits = [](const std::string& name) {
        return isShort(name, gltf::kMaxNameBytes + 16);
    };
    const auto named = [&](const auto& thing) { return fits(thing.name); };
    return std::ranges::all_of(scene.material_variants, fits) &&
           std::ranges::all_of(scene.cameras, named) &&
           std::ranges::all_of(scene.extensions, named) &&
           (!scene.motion || std::ranges::all_of(scene.motion->clips, named));
}

Fault faultInNumbers(const scene::Scene& scene) {
    const bool few =
        scene.cameras.size() <= gltf::kMaxChoices && scene.extensions.size() <= gltf::kMaxChoices &&
        scene.material_variants.size() <= gltf::kMaxChoices &&
        (!scene.motion || scene.motion->clips.size() <= gltf::kMaxChoices) &&
        scene.instances.size() <= gltf::kMaxInstances &&
        scene.materials.size() <= gltf::kMaxMaterials + 1 &&
        scene.lights.size() <= gltf::kMaxInstances && scene.warnings.size() <= 4096 &&
        scene.material_variant <= scene.material_variants.size() && namesAreShort(scene);
    return few ? Fault() : "it has more things, or longer names, than a file may have";
}

// Of all instances.
Fault faultInBounds(const BoundsD3& bounds) {
    const bool none = bounds == BoundsD3();
    return none || (isNear(bounds.min) && isNear(bounds.max) && !bounds.empty())
               ? Fault()
               : "its bounds are not finite";
}

} // namespace

Fault findDeliveredFault(const scene::Scene& scene) {
    for (Fault fault :
         {faultInNumbers(scene), scene::findFault(scene), faultInEach(scene.images, "image"),
          faultInEach(scene.meshes, "mesh"), faultInEach(scene.cameras, "camera"),
          faultInEach(scene.lights, "light"), faultInEach(scene.warnings, "warning"),
          faultInBounds(scene.bounds_world)}) {
        if (fault) {
            return fault;
        }
    }
    return {};
}

} // namespace froxel::bake
