// Boxes that hold what deforms in any pose, without a look at its vertices.
#pragma once

#include "motion/skin_pose.h"
#include "scene/motion.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::motion {

// What a primitive's boxes are made from; never changes.
struct DeformExtent {
    struct OfJoint {
        uint32_t joint = 0; // of Skin::joints
        Bounds3 box;        // of the vertices that it moves, without targets
    };
    Bounds3 box;                  // of all vertices, without skin and targets
    std::vector<OfJoint> joints;  // by rising joint, only those that move anything
    std::vector<Bounds3> targets; // of what each adds to positions; holds 0
};

[[nodiscard]] DeformExtent extentOf(const scene::Primitive& primitive,
                                    const scene::Deformation& deformation,
                                    size_t target_count);

// Holds all positions that deform() gives, and its rounding: a vertex lies in the hull of its
// images by the joints, as weights are not negative and sum to 1, and each morphed one in the sum
// of the boxes. In the axes of SkinPose with a skin, else in object space.
[[nodiscard]] BoundsD3
boundsOf(const DeformExtent& extent, std::span<const double> weights, const SkinPose* skin);

} // namespace froxel::motion
