#include "builtin_scene/angles.h"
#include "builtin_scene/furnishing.h"
#include "builtin_scene/profile.h"

#include <array>
#include <cmath>

namespace froxel::builtin_scene {
namespace {

void addDisc(MeshBuilder& mesh, float radius, float y, uint32_t sides) {
    std::vector<glm::vec3> rim;
    for (uint32_t i = 0; i < sides; ++i) {
        const float angle = kTwoPi * static_cast<float>(i) / static_cast<float>(sides);
        rim.emplace_back(radius * std::cos(angle), y, -radius * std::sin(angle));
    }
    mesh.polygon(rim);
}

// A flat hoop of a rectangular section about the y axis.
MeshBuilder hoop(Surface surface, float radius, float width, float thickness) {
    MeshBuilder ring(surface);
    const float inner = radius - 0.5F * thickness;
    const float outer = radius + 0.5F * thickness;
    const float half = 0.5F * width;
    addLathe(ring,
             Profile({inner, half})
                 .to({inner, -half})
                 .to({outer, -half})
                 .to({outer, half})
                 .to({inner, half}),
             40);
    return ring;
}

glm::mat4 tilted(float about_z_deg, float about_x_deg) {
    return turnedZ(glm::radians(about_z_deg)) * turnedX(glm::radians(about_x_deg));
}

// Rings of the heavens about a gilded earth, its middle at the origin, 0.85 m in radius.
MeshBuilder armillary() {
    MeshBuilder sphere(Surface::kBronze);
    constexpr float kRadius = 0.85F;
    constexpr float kObliquity_deg = 23.4F;
    const MeshBuilder meridian = hoop(Surface::kBronze, kRadius, 0.055F, 0.03F);
    for (const float turn : {0.0F, 60.0F, 120.0F}) {
        sphere.append(meridian,
                      tilted(kObliquity_deg, 0) * turnedY(glm::radians(turn)) * tilted(0, 90.0F));
    }
    sphere.append(hoop(Surface::kBronze, kRadius - 0.035F, 0.06F, 0.025F),
                  tilted(kObliquity_deg, 0));
    sphere.append(hoop(Surface::kGold, kRadius - 0.05F, 0.08F, 0.02F), tilted(0, 0));
    for (const float side : {-1.0F, 1.0F}) {
        constexpr float kTropicHeight = 0.338F; // sin of the obliquity, of the radius
        constexpr float kTropicRadius = 0.76F;
        sphere.append(hoop(Surface::kBronze, kTropicRadius, 0.035F, 0.025F),
                      tilted(kObliquity_deg, 0) * moved(0, side * kTropicHeight, 0));
    }
    MeshBuilder axis(Surface::kGold);
    addLathe(axis,
             Profile({0.0F, -1.12F})
                 .to({0.05F, -1.02F})
                 .to({0.014F, -0.96F})
                 .to({0.014F, 0.98F})
                 .to({0.06F, 1.0F})
                 .to({0.0F, 1.20F}),
             8);
    Profile earth({0.0F, -0.2F});
    earth.arc({0.0F, 0.4F}, 0.999F, 9);
    addLathe(axis, earth, 18);
    sphere.append(axis, tilted(kObliquity_deg, 0));
    return sphere;
}

} // namespace

MeshBuilder fountain() {
    MeshBuilder fountain(Surface::kRosso);
    addLathe(fountain,
             Profile({1.95F, 0.0F})
                 .by({0.0F, 0.12F})
                 .arc({-0.03F, 0.03F}, 0.4F, 2)
                 .by({-0.22F, 0.0F})
                 .by({0.0F, 0.12F})
                 .arc({-0.03F, 0.03F}, 0.4F, 2)
                 .by({-0.2F, 0.0F}),
             36);
    fountain.use(Surface::kPavonazzetto);
    addLathe(fountain,
             Profile({1.50F, 0.29F})
                 .by({0.0F, 0.06F})
                 .arc({-0.07F, 0.06F}, -0.4F, 3)
                 .by({0.0F, 0.22F})
                 .arc({0.09F, 0.08F}, -0.4F, 3)
                 .by({0.02F, 0.0F})
                 .arc({0.0F, 0.09F}, 0.9F, 4)
                 .by({-0.24F, 0.0F})
                 .arc({-0.03F, -0.03F}, 0.4F, 2)
                 .by({0.0F, -0.42F})
                 .by({-1.27F, 0.0F}),
             36);
    fountain.use(Surface::kGiallo);
    addLathe(fountain,
             Profile({0.34F, 0.34F})
                 .by({0.0F, 0.12F})
                 .arc({-0.06F, 0.08F}, -0.4F, 3)
                 .by({0.0F, 0.03F})
                 .arc({-0.14F, 0.40F}, -0.35F, 4)
                 .arc({0.0F, 0.09F}, 0.9F, 3)
                 .arc({0.10F, 0.14F}, -0.3F, 3),
             20);
    fountain.use(Surface::kPavonazzetto);
    addLathe(fountain,
             Profile({0.18F, 1.18F})
                 .arc({0.58F, 0.20F}, 0.35F, 5)
                 .arc({0.0F, 0.07F}, 0.9F, 3)
                 .by({-0.08F, 0.0F})
                 .arc({-0.68F, -0.12F}, -0.2F, 4),
             28);
    fountain.use(Surface::kBronze);
    addLathe(fountain,
             Profile({0.20F, 1.28F})
                 .arc({-0.10F, 0.14F}, -0.4F, 3)
                 .by({0.0F, 0.05F})
                 .arc({0.0F, 0.08F}, 0.9F, 3)
                 .by({-0.04F, 0.14F})
                 .by({0.05F, 0.06F})
                 .by({-0.11F, 0.04F}),
             14);
    fountain.append(armillary(), moved(0, 2.80F, 0));
    fountain.use(Surface::kWater);
    addDisc(fountain, 1.26F, 0.66F, 36);
    addDisc(fountain, 0.68F, 1.41F, 24);
    return fountain;
}

} // namespace froxel::builtin_scene
