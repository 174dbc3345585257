// Meshlets of a scene, wherever they are placed (scalar block layout).
#ifndef FROXEL_INTERFACE_MESHLET_IO_H
#define FROXEL_INTERFACE_MESHLET_IO_H

#include "compat.h"
#ifdef __cplusplus
#include <limits>
#endif

FROXEL_IO_NAMESPACE_BEGIN

// At most. Small meshlets cull well and still amortise a draw.
FROXEL_CONST uint kMeshletVertices = 96U;
FROXEL_CONST uint kMeshletTriangles = 124U;

// A run of triangles with its bounding sphere and normal cone, in object space. All of its
// triangles face away from an eye where dot(normalize(center - eye), axis) >= cutoff + radius term;
// cone_cutoff of 1 means never (meshoptimizer, meshopt_computeMeshletBounds). first_word: of its
// vertices, as indices of the mesh's; then of a word a triangle, which has three of those vertices,
// by number, in 8 bits each, the first lowest.
struct Meshlet {
    uint first_index FROXEL_USUAL(0);
    uint index_count FROXEL_USUAL(0);
    uint first_word FROXEL_USUAL(0);
    uint vertex_count FROXEL_USUAL(0);
    vec3 center FROXEL_USUAL(0);
    float radius FROXEL_USUAL(0);
    vec3 cone_axis FROXEL_USUAL(0);
    float cone_cutoff FROXEL_USUAL(1);
};
FROXEL_SIZE_ASSERT(Meshlet, 48);

// A surface that stands for a finer one, which lies within the sphere: how far the two are apart,
// in object space; no less than that of what it was made of.
struct DetailError {
    vec3 center FROXEL_USUAL(0);
    float radius FROXEL_USUAL(0);
    float error FROXEL_USUAL(0);
};
FROXEL_SIZE_ASSERT(DetailError, 20);

#ifdef __cplusplus
inline constexpr DetailError kNothingCoarser{vec3(0), 0, std::numeric_limits<float>::infinity()};
#endif

// A meshlet is to be drawn where its own error is small enough and that of the coarser surface that
// replaces it is not. Of all meshlets over a place exactly one is, if a smaller error is found for
// what a surface was made of than for itself. own: 0 of the mesh itself.
struct MeshletDetail {
    DetailError own;
    DetailError coarser FROXEL_USUAL(kNothingCoarser);
};
FROXEL_SIZE_ASSERT(MeshletDetail, 40);

FROXEL_IO_NAMESPACE_END

#endif
