// Tangents where a file has none, those that glTF 2.0 (3.7.2.1) asks for: MikkTSpace's (Mikkelsen
// 2008, "Simulation of Wrinkled Surfaces Revisited"), from positions, normals and the coordinates
// of the normal texture as the file has them.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::gltf {

// Of each corner of each triangle: xyz unit and on the plane of the corner's normal, w as glTF has
// it: the bitangent, w (normal x tangent), points against rising v. Triangles share a corner's
// tangent across edges whose ends agree in position, normal and coordinates, unless one is mirrored
// in the texture and the other is not. Where no triangle says, any direction on the plane.
// Triangles about one corner whose tangents are exactly opposite share one, where MikkTSpace parts
// them.
[[nodiscard]] std::vector<glm::vec4> cornerTangents(const scene::Primitive& primitive,
                                                    std::span<const glm::vec2> uv);

// Gives the primitive's vertices their corners' tangents. Where corners of a vertex differ, copies
// of the vertex are put at the end: of which ones, in order.
[[nodiscard]] std::vector<uint32_t> addTangents(scene::Primitive& primitive,
                                                const std::vector<glm::vec4>& corner_tangents);

} // namespace froxel::gltf
