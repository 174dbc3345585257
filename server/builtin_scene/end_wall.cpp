#include "builtin_scene/angles.h"
#include "builtin_scene/bay.h"
#include "builtin_scene/furnishing.h"
#include "builtin_scene/plan.h"
#include "builtin_scene/profile.h"
#include "builtin_scene/wall.h"

#include <cmath>
#include <vector>

namespace froxel::builtin_scene {
namespace {

constexpr float kTopOfSides = 9.7F;
constexpr float kNaveHalf = 3.9F; // the part under the vault, a little behind its springing
constexpr float kRoseRadius = 1.35F;
constexpr float kPortalRadius = 1.25F;
constexpr float kPortalSpring = 2.7F;

glm::vec3 onCircle(float radius, float angle, float z) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// The rose's stonework in the plane z = 0: a moulded rim, an inner wheel, twelve spokes and cusps.
MeshBuilder roseTracery() {
    MeshBuilder tracery(Surface::kLimestone);
    addTube(tracery, 48, 8, 0.14F, true,
            [](float t) { return onCircle(kRoseRadius + 0.10F, 2 * kPi * t, 0.0F); });
    addTube(tracery, 24, 8, 0.055F, true,
            [](float t) { return onCircle(0.36F, 2 * kPi * t, -0.12F); });
    MeshBuilder petal(Surface::kLimestone);
    petal.box({-0.032F, 0.36F, -0.17F}, {0.032F, 1.05F, -0.07F}, 0.012F, kTop | kBottom);
    MeshBuilder cusp(Surface::kLimestone);
    addTube(cusp, 8, 6, 0.04F, false, [](float t) {
        return glm::vec3(0.272F * std::cos(kPi * t), 1.0F + 0.30F * std::sin(kPi * t), -0.12F);
    });
    petal.append(cusp, turnedZ(kPi / 12.0F));
    for (uint32_t i = 0; i < 12; ++i) {
        tracery.append(petal, turnedZ(2 * kPi * static_cast<float>(i) / 12.0F));
    }
    return tracery;
}

// Stonework, coloured glass and the dusk behind, about the origin.
MeshBuilder rose() {
    MeshBuilder rose = roseTracery();
    const auto pane = [&](Surface surface, float z) {
        rose.use(surface);
        rose.polygon({{-kRoseRadius, -kRoseRadius, z},
                      {kRoseRadius, -kRoseRadius, z},
                      {kRoseRadius, kRoseRadius, z},
                      {-kRoseRadius, kRoseRadius, z}});
    };
    pane(Surface::kStainedGlass, -0.16F);
    pane(Surface::kSky, -0.295F);
    return rose;
}

// The frame of the gate, and the doors where there are some.
MeshBuilder gateFrame(End end) {
    MeshBuilder frame(Surface::kLimestone);
    if (end == End::kEast) {
        addRing(frame, {.radius = plan::kApseRadius,
                        .height = 0.5F,
                        .half_depth = 0.06F,
                        .count = 27,
                        .bevel = 0.015F,
                        .omit = kBack});
        MeshBuilder raised(Surface::kLimestone);
        raised.append(frame, moved(0, plan::kApseSpring, 0));
        return raised;
    }
    addRing(
        frame,
        {.radius = kPortalRadius, .height = 0.4F, .half_depth = 0.08F, .count = 15, .omit = kBack});
    MeshBuilder portal(Surface::kLimestone);
    portal.append(frame, moved(0, kPortalSpring, 0));
    portal.append(portalDoors(kPortalRadius, kPortalSpring), moved(0, 0, -0.3F));
    return portal;
}

} // namespace

MeshBuilder endWall(End end) {
    constexpr float kRoseY = 10.45F;
    MeshBuilder wall(Surface::kAshlar);
    const Opening window = roundOpening(0, kRoseY, kRoseRadius, 32);
    const Opening gate = end == End::kEast
                             ? archOpening(0, plan::kApseRadius, 0, plan::kApseSpring, 28, true)
                             : archOpening(0, kPortalRadius, 0, kPortalSpring, 16, true);
    const float centre_y = plan::kVaultSpring + plan::kVaultRise - plan::kVaultRadius;
    const Curve behind_vault = [=](float x) {
        const float radius = plan::kVaultRadius + 0.15F;
        return centre_y + std::sqrt(radius * radius - x * x);
    };
    std::vector<float> cuts;
    for (int i = -9; i <= 9; ++i) {
        cuts.push_back(0.4F * static_cast<float>(i));
    }
    addWall(wall, -kNaveHalf, kNaveHalf, level(0), behind_vault, {window, gate}, cuts);
    addWall(wall, -8.1F, -kNaveHalf, level(0), level(kTopOfSides), {});
    addWall(wall, kNaveHalf, 8.1F, level(0), level(kTopOfSides), {});
    addReveal(wall, window, 0.3F);
    addReveal(wall, gate, plan::kEndWallDepth);
    wall.append(gateFrame(end), glm::mat4(1.0F));
    wall.append(rose(), moved(0, kRoseY, 0));

    MeshBuilder placed(Surface::kAshlar);
    placed.append(wall, turnedY(0.5F * kPi));
    return placed;
}

} // namespace froxel::builtin_scene
