#include "builtin_scene/furnishing.h"
#include "builtin_scene/profile.h"

#include <array>
#include <vector>

namespace froxel::builtin_scene {
namespace {

constexpr float kThickness = 0.006F;

// A pane from corner `o` along `u` and `v`, seen from both sides: behind its face another one.
void addPane(MeshBuilder& mesh, glm::vec3 o, glm::vec3 u, glm::vec3 v) {
    const glm::vec3 back = glm::normalize(glm::cross(u, v)) * -kThickness;
    mesh.polygon({o, o + u, o + u + v, o + v});
    mesh.polygon({o + back, o + v + back, o + u + v + back, o + u + back});
}

} // namespace

MeshBuilder goblet(Surface glass) {
    MeshBuilder goblet(glass);
    addLathe(goblet,
             Profile({0.075F, 0.0F})
                 .by({0.0F, 0.006F})
                 .to({0.014F, 0.024F})
                 .by({0.0F, 0.13F})
                 .arc({0.076F, 0.11F}, 0.3F, 5)
                 .by({-0.008F, 0.12F})
                 .by({-0.005F, 0.0F})
                 .by({0.007F, -0.116F})
                 .arc({-0.084F, -0.102F}, -0.3F, 5),
             24);
    return goblet;
}

MeshBuilder glassScreen(Surface glass) {
    MeshBuilder screen(glass);
    addPane(screen, {-0.24F, 0.0F, 0.0F}, {0.48F, 0, 0}, {0, 0.52F, 0});
    return screen;
}

MeshBuilder vitrine() {
    constexpr float kHalfX = 0.30F;
    constexpr float kHalfZ = 0.34F;
    constexpr float kHeight = 0.50F;
    MeshBuilder frame(Surface::kBronze);
    for (const float x : {-kHalfX, kHalfX}) {
        for (const float z : {-kHalfZ, kHalfZ}) {
            frame.box({x - 0.01F, 0.0F, z - 0.01F}, {x + 0.01F, kHeight + 0.01F, z + 0.01F}, 0.003F,
                      kBottom);
        }
    }
    frame.use(Surface::kGlass);
    const glm::vec3 up(0, kHeight, 0);
    addPane(frame, {-kHalfX, 0, kHalfZ}, {2 * kHalfX, 0, 0}, up);
    addPane(frame, {kHalfX, 0, -kHalfZ}, {-2 * kHalfX, 0, 0}, up);
    addPane(frame, {kHalfX, 0, kHalfZ}, {0, 0, -2 * kHalfZ}, up);
    addPane(frame, {-kHalfX, 0, -kHalfZ}, {0, 0, 2 * kHalfZ}, up);
    addPane(frame, {-kHalfX, kHeight, kHalfZ}, {2 * kHalfX, 0, 0}, {0, 0, -2 * kHalfZ});
    return frame;
}

MeshBuilder stoneTable() {
    MeshBuilder table(Surface::kPavonazzetto);
    table.box({-0.55F, 0.80F, -1.05F}, {0.55F, 0.88F, 1.05F}, 0.012F);
    table.use(Surface::kRosso);
    for (const float z : {-0.72F, 0.72F}) {
        table.box({-0.40F, 0.0F, z - 0.11F}, {0.40F, 0.80F, z + 0.11F}, 0.015F, kBottom | kTop);
    }
    return table;
}

} // namespace froxel::builtin_scene
