#include "builtin_scene/furnishing.h"
#include "builtin_scene/profile.h"

#include <cmath>

namespace froxel::builtin_scene {

MeshBuilder knotOnPlinth() {
    MeshBuilder statue(Surface::kPavonazzetto);
    statue.box({-0.75F, -0.02F, -0.75F}, {0.75F, 0.18F, 0.75F}, 0.02F, kBottom);
    statue.box({-0.62F, 0.17F, -0.62F}, {0.62F, 0.30F, 0.62F}, 0.03F, kBottom);
    statue.use(Surface::kRosso);
    addLathe(statue, Profile({0.52F, 0.29F}).by({-0.02F, 0.8F}), 28);
    statue.use(Surface::kGold);
    addLathe(
        statue,
        Profile({0.50F, 0.34F}).by({0.05F, 0.0F}).arc({0.0F, 0.08F}, 0.9F, 3).by({-0.05F, 0.0F}),
        28);
    statue.use(Surface::kPavonazzetto);
    addLathe(statue,
             Profile({0.49F, 1.05F})
                 .arc({0.10F, 0.10F}, -0.4F, 3)
                 .by({0.0F, 0.07F})
                 .arc({-0.04F, 0.04F}, 0.4F, 2)
                 .by({-0.55F, 0.02F}),
             28);
    statue.use(Surface::kGold);
    // A trefoil on a torus, standing upright.
    MeshBuilder knot(Surface::kGold);
    addTube(knot, 120, 10, 0.135F, true, [](float t) {
        const float angle = 2.0F * glm::two_pi<float>() * t;
        const float wind = 1.5F * angle;
        const float radius = 0.56F + 0.26F * std::cos(wind);
        return glm::vec3(0.26F * std::sin(wind), radius * std::cos(angle),
                         radius * std::sin(angle));
    });
    statue.append(knot, moved(0, 2.22F, 0));
    return statue;
}

} // namespace froxel::builtin_scene
