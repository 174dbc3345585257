// Plants: alpha-masked cards on closed pots and beds. Each at its own origin, on y = 0 unless said
// otherwise; `seed` makes siblings differ.
#pragma once

#include "builtin_scene/mesh_builder.h"

#include <cstdint>

namespace froxel::builtin_scene {

// A fern in a terracotta pot, 1.2 m high.
[[nodiscard]] MeshBuilder pottedFern(uint32_t seed);

// A small round-headed tree in a stone tub, 2.9 m high.
[[nodiscard]] MeshBuilder pottedTree(uint32_t seed);

// A raised bed of `width` metres along x against a wall at z = 0, planted with ferns, ivy on the
// wall behind it up to `climb` metres.
[[nodiscard]] MeshBuilder plantingBed(float width, float climb, uint32_t seed);

// Ivy that winds up a nave column.
[[nodiscard]] MeshBuilder ivyOnColumn(uint32_t seed);

// Ivy that hangs from an edge along x at the origin, `width` wide, in front of z = 0.
[[nodiscard]] MeshBuilder ivyCurtain(float width, float drop, uint32_t seed);

} // namespace froxel::builtin_scene
