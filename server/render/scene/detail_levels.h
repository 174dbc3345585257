// Coarser levels of a mesh: a hierarchy of meshlets, of which each view takes those that are as
// near to the mesh as it asks for, finer ones where it is close. Groups of neighbouring meshlets
// are simplified with their borders locked, so that groups of any two levels meet without a crack
// (Karis, Stubbe and Wihlidal 2021, A Deep Dive into Nanite Virtualized Geometry).
#pragma once

#include "render/scene/meshlets.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace froxel::render {

// A surface that stands for a finer one, which lies within the sphere: how far the two are apart,
// in object space.
struct DetailError {
    glm::vec3 center{0};
    float radius = 0;
    float error = 0; // no less than that of what it was made of
};

inline constexpr float kNothingCoarser = std::numeric_limits<float>::infinity();

// A meshlet is to be drawn where its own error is small enough and that of the coarser surface that
// replaces it is not. Of all meshlets over a place exactly one is, if a smaller error is found for
// what a surface was made of than for itself.
struct MeshletDetail {
    DetailError own;                             // 0: the mesh itself
    DetailError coarser{{}, 0, kNothingCoarser}; // by default nothing replaces it
};

struct DetailLevels {
    MeshletList coarser;                // meshlets of all levels but the mesh itself
    std::vector<MeshletDetail> details; // of the mesh's meshlets, then of those
};

// meshlets: of all of the mesh, first_index into `indices`, which are the positions'. On as many
// threads as pay; the same mesh gives the same result.
[[nodiscard]] DetailLevels buildDetailLevels(std::span<const glm::vec3> positions,
                                             std::span<const uint32_t> indices,
                                             std::span<const Meshlet> meshlets);

} // namespace froxel::render
