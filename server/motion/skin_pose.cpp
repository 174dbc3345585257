#include "motion/skin_pose.h"

#include "motion/affine.h"
#include "scene/transform.h"

namespace froxel::motion {

void poseSkin(const scene::Skin& skin, const Pose& pose, SkinPose& out) {
    const auto worldOf = [&](size_t joint) {
        return pose.world_from_node[skin.joints[joint]] * glm::dmat4(skin.joint_from_object[joint]);
    };
    const glm::dmat4 first = worldOf(0);
    const bool known = scene::isUsable(first);
    const glm::dvec3 anchor_world = known ? glm::dvec3(first[3]) : glm::dvec3(0);
    const double side = known && glm::determinant(glm::dmat3(first)) < 0 ? -1 : 1;
    out.world_from_posed = glm::dmat4(1);
    out.world_from_posed[0].x = side;
    out.world_from_posed[3] = glm::dvec4(anchor_world, 1);
    out.joints.assign(skin.joints.size(), {});
    for (size_t i = 0; i < skin.joints.size(); ++i) {
        glm::dmat4 world_from_object = worldOf(i);
        if (!scene::isUsable(world_from_object)) {
            continue;
        }
        world_from_object[3] -= glm::dvec4(anchor_world, 0);
        const glm::dmat4 rows = glm::transpose(world_from_object);
        out.joints[i] = {{glm::vec4(side * rows[0]), glm::vec4(rows[1]), glm::vec4(rows[2])}};
    }
}

} // namespace froxel::motion
