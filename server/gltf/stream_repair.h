// Vertex streams with numbers that are not finite, made such that the rest of them can be drawn.
#pragma once

#include "gltf/warnings.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace froxel::gltf {

// Afterwards all streams are finite but texture coordinates. Triangles at positions that are not
// are dropped and colours become white, with a warning each. Normals and tangents become 0, which
// is no direction: their readers mend that. `pointer` and `user` name the primitive.
void repairStreams(scene::Primitive& primitive,
                   const std::string& pointer,
                   const std::string& user,
                   Warnings& warnings);

// Coordinates that are not finite become 0, with a warning.
void repairTexcoords(std::vector<glm::vec2>& texcoords,
                     const std::string& semantic,
                     const std::string& pointer,
                     const std::string& user,
                     Warnings& warnings);

// Gives each of `vertices` the direction of the sum of its triangles' normals by their areas; +Y
// where they have none.
void recomputeNormals(scene::Primitive& primitive, const std::vector<uint32_t>& vertices);

} // namespace froxel::gltf
