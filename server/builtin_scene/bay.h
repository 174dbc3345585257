// The walls of one bay, its middle at x = 0; in hall coordinates for the north side (z < 0).
#pragma once

#include "builtin_scene/mesh_builder.h"

namespace froxel::builtin_scene {

// Both storeys of the arcade between nave and aisle, without columns.
[[nodiscard]] MeshBuilder arcadeBay();

// The outer wall with a window in each storey, the gallery's floor and ceiling.
[[nodiscard]] MeshBuilder outerBay();

enum class End { kWest, kEast };
// An end wall at x = 0 that faces +x for the west (turned for the east): a portal or the opening
// of the apse, a rose above it.
[[nodiscard]] MeshBuilder endWall(End end);

// The half-round apse and its steps, in hall coordinates (it stands beyond the east wall).
[[nodiscard]] MeshBuilder apse();

// The floor of nave and aisles, in hall coordinates.
[[nodiscard]] MeshBuilder groundFloor();

} // namespace froxel::builtin_scene
