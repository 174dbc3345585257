// The joints of a skin in a pose, ready for vertices in single precision.
#pragma once

#include "motion/pose.h"
#include "scene/motion.h"

#include <vector>

namespace froxel::motion {

// By rows: what a vertex is multiplied with.
struct JointMatrix {
    glm::vec4 row[3];
};
static_assert(sizeof(JointMatrix) == 48);

// Vertices that a skin moves stand in axes of their own: where the first joint takes the mesh's
// origin, along the world's axes, x turned round where that joint mirrors. joint_posed =
// posed_from_world * world_from_joint * inverse bind matrix (glTF 2.0, 3.7.3). Single precision
// holds them, so that a character is as exact a thousand kilometres away as at home, and whoever
// places them by world_from_posed sees a mirrored instance where there is one.
struct SkinPose {
    glm::dmat4 world_from_posed{1};
    std::vector<JointMatrix> joints;
};

// Replaces the contents of `out`, whose memory is reused. The skin has at least one joint. A joint
// whose matrix leaves the range of single precision takes all that it moves to the origin of these
// axes.
void poseSkin(const scene::Skin& skin, const Pose& pose, SkinPose& out);

} // namespace froxel::motion
