// Ceilings: the nave's coffered barrel and the aisles' groin vaults.
#pragma once

#include "builtin_scene/mesh_builder.h"

namespace froxel::builtin_scene {

enum class Crown { kCoffered, kSkylight, kOculus };

// One bay of the barrel vault in hall coordinates (y, z) with the bay's middle at x = 0.
[[nodiscard]] MeshBuilder barrelBay(Crown crown);

// The transverse rib of one line, at x = 0.
[[nodiscard]] MeshBuilder barrelRib();

// One bay of groin vault over an aisle, its middle at x = z = 0.
[[nodiscard]] MeshBuilder groinBay();

// The arch across an aisle at a line of columns, at x = 0, its middle at z = 0.
[[nodiscard]] MeshBuilder aisleArch();

} // namespace froxel::builtin_scene
