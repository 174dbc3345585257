// Coarser levels of a mesh: a hierarchy of meshlets, of which each view takes those that are as
// near to the mesh as it asks for, finer ones where it is close. Groups of neighbouring meshlets
// are simplified with their borders locked, so that groups of any two levels meet without a crack
// (Karis, Stubbe and Wihlidal 2021, A Deep Dive into Nanite Virtualized Geometry).
#pragma once

#include "render/scene/meshlets.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::render {

using io::DetailError;
using io::MeshletDetail;

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
