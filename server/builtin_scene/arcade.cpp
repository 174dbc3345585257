#include "builtin_scene/bay.h"
#include "builtin_scene/plan.h"
#include "builtin_scene/profile.h"
#include "builtin_scene/wall.h"

namespace froxel::builtin_scene {
namespace {

constexpr float kHalf = 0.5F * plan::kBay;
constexpr float kUpperHalfDepth = 0.2F;

// Cavetto and fillet under a corona: `run` metres out over `rise` metres up, starting at z, y.
Profile cornice(float z, float y, float run, float rise) {
    return Profile({z, y})
        .by({0.12F * run, 0.0F})
        .by({0.0F, 0.12F * rise})
        .arc({0.38F * run, 0.34F * rise}, -0.38F, 4)
        .by({0.0F, 0.06F * rise})
        .by({0.30F * run, 0.0F})
        .by({0.0F, 0.22F * rise})
        .arc({0.20F * run, 0.20F * rise}, 0.35F, 3)
        .by({0.0F, 0.06F * rise})
        .to({z, y + rise});
}

// Both faces of a wall with arches, its middle plane at z = 0.
void addFaces(MeshBuilder& mesh,
              float half_depth,
              float bottom,
              float top,
              const std::vector<Opening>& openings) {
    MeshBuilder face = mesh.fresh();
    addWall(face, -kHalf, kHalf, level(bottom), level(top), openings);
    mesh.append(face, moved(0, 0, half_depth));
    mesh.append(face, moved(0, 0, -half_depth) * turnedY(glm::pi<float>()));
}

} // namespace

MeshBuilder arcadeBay() {
    MeshBuilder bay(Surface::kAshlar);
    // The openings are cut behind the rings, which cover the cut.
    addFaces(bay, plan::kArcadeHalfDepth, plan::kSpring, plan::kGalleryFloor,
             {archOpening(0, plan::kArchRadius + 0.3F, plan::kSpring, plan::kSpring, 18, true)});
    addFaces(bay, kUpperHalfDepth, plan::kUpperSpring, plan::kFrieze + 0.1F,
             {archOpening(-0.5F * kHalf, plan::kUpperRadius + 0.12F, plan::kUpperSpring,
                          plan::kUpperSpring, 12, true),
              archOpening(0.5F * kHalf, plan::kUpperRadius + 0.12F, plan::kUpperSpring,
                          plan::kUpperSpring, 12, true)});

    bay.use(Surface::kLimestone);
    MeshBuilder ring(Surface::kLimestone);
    addRing(ring, {.radius = plan::kArchRadius, .height = 0.4F, .half_depth = 0.29F, .count = 15});
    bay.append(ring, moved(0, plan::kSpring, 0));
    MeshBuilder small(Surface::kLimestone);
    addRing(small, {.radius = plan::kUpperRadius,
                    .height = 0.21F,
                    .half_depth = 0.225F,
                    .count = 9,
                    .bevel = 0.009F,
                    .omit = kTop});
    for (const float side : {-0.5F, 0.5F}) {
        bay.append(small, moved(side * kHalf, plan::kUpperSpring, 0));
    }

    // String course under the gallery, the plinth of its columns, and the main cornice.
    addMoulding(bay, cornice(plan::kArcadeHalfDepth - 0.01F, 5.68F, 0.24F, 0.34F), -kHalf, kHalf);
    bay.box({-kHalf, 5.90F, -0.28F}, {kHalf, 6.12F, 0.30F}, 0.012F, kLeft | kRight | kBottom);
    addMoulding(
        bay, Profile({kUpperHalfDepth - 0.01F, plan::kFrieze - 0.08F}).arc({0.0F, 0.09F}, 1.0F, 4),
        -kHalf, kHalf);
    addMoulding(bay, cornice(kUpperHalfDepth, 9.62F, 0.42F, 0.42F), -kHalf, kHalf);

    bay.use(Surface::kMosaic);
    MeshBuilder frieze(Surface::kMosaic);
    addWall(frieze, -kHalf, kHalf, level(plan::kFrieze), level(9.65F), {});
    bay.append(frieze, moved(0, 0, kUpperHalfDepth + 0.01F));
    bay.use(Surface::kAshlar);
    MeshBuilder behind(Surface::kAshlar);
    addWall(behind, -kHalf, kHalf, level(plan::kFrieze + 0.1F), level(9.7F), {});
    bay.append(behind, moved(0, 0, -kUpperHalfDepth) * turnedY(glm::pi<float>()));

    MeshBuilder placed(Surface::kAshlar);
    placed.append(bay, moved(0, 0, -plan::kColumnZ));
    return placed;
}

} // namespace froxel::builtin_scene
