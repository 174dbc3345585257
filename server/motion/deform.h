// Vertices moved by morph targets and a skin, in single precision on the host.
#pragma once

#include "motion/skin_pose.h"
#include "scene/motion.h"

#include <span>
#include <vector>

namespace froxel::motion {

// Vertices of a primitive as they are drawn: by a skin in the axes of SkinPose, else in object
// space.
struct PosedVertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // unit
    std::vector<glm::vec4> tangents; // as the primitive's: xyz unit, w the handedness
};

// weights: of all of the mesh's targets. skin: null where the deformation has no influences.
// Morphing comes first: p + sum w dp, likewise normals and tangents (3.7.2.2). Then p' = sum w_j
// joint_j p; normals by the cofactors of that sum, times its determinant's sign, tangents by
// itself, their handedness by that sign. What ends without a direction keeps the one before, a
// position that leaves the range of numbers its own. Flat normals are those of the moved triangles.
// Sums run by rising target, and by influence as they stand. Replaces the contents of `out`, whose
// memory is reused.
void deform(const scene::Primitive& primitive,
            const scene::Deformation& deformation,
            std::span<const double> weights,
            const SkinPose* skin,
            PosedVertices& out);

} // namespace froxel::motion
