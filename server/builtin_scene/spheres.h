// A scene of as many triangles as one wants, to measure with.
#pragma once

#include "scene/scene.h"
#include "settings/ranges.h"

#include <cstdint>

namespace froxel::builtin_scene {

inline constexpr uint32_t kSphereMeshes = 10;

struct SphereField {
    uint32_t triangle_count = 1'000'000; // of all meshes together, at least about so many
    uint32_t copy_count = 1;             // of each mesh
};

// GLB files end at 4 GiB.
inline constexpr settings::Range<uint32_t> kSphereTrianglesRange{"spheres", 1'000, 100'000'000};
inline constexpr settings::Range<uint32_t> kSphereCopiesRange{"copies", 1, 100'000};

// Bumpy spheres of radius 1 m in a square on the ground, of kSphereMeshes meshes in turn, and the
// camera "Field", which sees them from a side.
[[nodiscard]] scene::Scene makeSpheres(const SphereField& field);

} // namespace froxel::builtin_scene
