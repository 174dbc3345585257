#include "builtin_scene/furnishing.h"
#include "builtin_scene/profile.h"

#include <cmath>

namespace froxel::builtin_scene {
namespace {

constexpr float kHalfSpan = 0.95F; // the ends vanish in the columns' shafts
constexpr float kRail = 0.98F;

void addRails(MeshBuilder& mesh) {
    mesh.box({-kHalfSpan, kRail - 0.12F, -0.11F}, {kHalfSpan, kRail, 0.11F}, 0.02F, kLeft | kRight);
    mesh.box({-kHalfSpan, 0.10F, -0.09F}, {kHalfSpan, 0.20F, 0.09F}, 0.015F,
             kLeft | kRight | kBottom);
}

} // namespace

MeshBuilder balustrade() {
    MeshBuilder panel(Surface::kLimestone);
    addRails(panel);
    constexpr uint32_t kCount = 5;
    MeshBuilder baluster(Surface::kLimestone);
    addLathe(baluster,
             Profile({0.075F, 0.19F})
                 .by({0.0F, 0.05F})
                 .by({-0.035F, 0.03F})
                 .arc({0.0F, 0.28F}, 0.36F, 3)
                 .by({-0.012F, 0.14F})
                 .by({0.035F, 0.02F})
                 .by({0.0F, 0.16F}),
             8);
    for (uint32_t i = 0; i < kCount; ++i) {
        panel.append(baluster, moved(0.37F * (static_cast<float>(i) - 0.5F * (kCount - 1)), 0, 0));
    }
    return panel;
}

MeshBuilder grilleParapet() {
    MeshBuilder panel(Surface::kLimestone);
    addRails(panel);
    panel.use(Surface::kGrille);
    // Two tiles and a bit across, one and a bit up: the lattice meets the rails at its bars.
    panel.polygon({{-kHalfSpan, 0.18F, 0},
                   {kHalfSpan, 0.18F, 0},
                   {kHalfSpan, 0.88F, 0},
                   {-kHalfSpan, 0.88F, 0}});
    return panel;
}

MeshBuilder roundel(Surface disc) {
    MeshBuilder upright(Surface::kLimestone);
    addLathe(upright, Profile({0.46F, 0.0F}).arc({-0.09F, 0.0F}, 0.95F, 4), 24);
    upright.use(disc);
    addLathe(upright, Profile({0.38F, 0.02F}).arc({-0.38F, 0.05F}, 0.08F, 2), 24);
    MeshBuilder facing(disc);
    facing.append(upright, turnedX(glm::half_pi<float>()));
    return facing;
}

MeshBuilder portalDoors(float radius, float spring) {
    MeshBuilder doors(Surface::kBronze);
    const float top = spring + radius;
    doors.polygon({{-radius, 0, 0}, {radius, 0, 0}, {radius, top, 0}, {-radius, top, 0}});
    MeshBuilder boss(Surface::kGold);
    addLathe(boss, Profile({0.06F, 0.0F}).arc({-0.06F, 0.04F}, 0.3F, 3), 10);
    const glm::mat4 forward = turnedX(glm::half_pi<float>());
    constexpr uint32_t kRows = 4;
    const float pitch = spring / kRows;
    for (const float side : {-1.0F, 1.0F}) {
        const float middle = side * 0.5F * radius;
        const float half = 0.5F * radius - 0.09F;
        for (uint32_t row = 0; row < kRows; ++row) {
            const float y0 = pitch * static_cast<float>(row) + 0.08F;
            const float y1 = y0 + pitch - 0.12F;
            doors.use(Surface::kBronze);
            doors.box({middle - half, y0, -0.01F}, {middle + half, y1, 0.035F}, 0.02F, kBack);
            doors.box({middle - half + 0.09F, y0 + 0.09F, 0.0F},
                      {middle + half - 0.09F, y1 - 0.09F, 0.07F}, 0.025F, kBack);
            doors.append(boss, moved(middle, 0.5F * (y0 + y1), 0.07F) * forward);
        }
        doors.use(Surface::kGold);
        MeshBuilder ring(Surface::kGold);
        addTube(ring, 16, 5, 0.016F, true, [](float t) {
            const float angle = glm::two_pi<float>() * t;
            return glm::vec3(0.09F * std::cos(angle), 0.09F * std::sin(angle), 0);
        });
        doors.append(ring, moved(side * 0.16F, 1.14F, 0.09F));
    }
    doors.use(Surface::kBronze);
    doors.box({-0.035F, 0, -0.01F}, {0.035F, top, 0.06F}, 0.012F, kBack | kBottom | kTop);
    doors.box({-radius, spring - 0.03F, -0.01F}, {radius, spring + 0.05F, 0.05F}, 0.012F,
              kBack | kLeft | kRight);
    return doors;
}

} // namespace froxel::builtin_scene
