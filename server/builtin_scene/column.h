// The two orders of columns, and what stands in for them at the walls. All stand on y = 0.
#pragma once

#include "builtin_scene/mesh_builder.h"

namespace froxel::builtin_scene {

// Fluted, on an attic base, with two rows of acanthus and volutes under the abacus; 3.4 m high,
// its abacus 1 m square.
[[nodiscard]] MeshBuilder naveColumn();

// A smooth marble shaft with a cushion capital, 2 m high, its abacus 0.46 m square.
[[nodiscard]] MeshBuilder galleryColumn(Surface shaft);

// A flat pilaster against a wall at z = 0, facing +z; as high as a nave column.
[[nodiscard]] MeshBuilder wallPilaster();

} // namespace froxel::builtin_scene
