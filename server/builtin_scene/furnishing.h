// What stands and hangs in the hall. Each at its own origin, on y = 0 unless said otherwise.
#pragma once

#include "builtin_scene/mesh_builder.h"

namespace froxel::builtin_scene {

// fountain.cpp
// A round basin on two steps with an upper bowl and an armillary sphere; 3.9 m high.
[[nodiscard]] MeshBuilder fountain();

// statue.cpp
// A gilded knot on a porphyry drum.
[[nodiscard]] MeshBuilder knotOnPlinth();

// joinery.cpp
// The parapet between two gallery columns, along x: balusters of stone or a bronze lattice.
[[nodiscard]] MeshBuilder balustrade();
[[nodiscard]] MeshBuilder grilleParapet();
// A disc of marble in a stone ring, facing +z, its middle at the origin.
[[nodiscard]] MeshBuilder roundel(Surface disc);
// Two bronze leaves that fill a doorway with a round head, facing +z.
[[nodiscard]] MeshBuilder portalDoors(float radius, float spring);

// lamps.cpp
// A six-sided lantern of bronze and glass that hangs `drop` metres below the origin.
[[nodiscard]] MeshBuilder lantern(float drop, float scale);

// glassware.cpp
// A goblet 0.38 m high: what is seen of it is its near side and the inside of its far one.
[[nodiscard]] MeshBuilder goblet(Surface glass);
// A pane 0.48 m wide and 0.52 m high, upright in the plane z = 0.
[[nodiscard]] MeshBuilder glassScreen(Surface glass);
// A case of clear panes between bronze posts, 0.6 x 0.5 x 0.68 m.
[[nodiscard]] MeshBuilder vitrine();
// A slab on two feet, 2.1 m along z, its top at 0.88 m.
[[nodiscard]] MeshBuilder stoneTable();

// banner.cpp
// A swallow-tailed cloth on a gilded rod, hanging from the origin, facing +z.
[[nodiscard]] MeshBuilder banner(float width, float length);

} // namespace froxel::builtin_scene
