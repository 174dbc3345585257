#include "builtin_scene/furnishing.h"
#include "builtin_scene/profile.h"

#include <cmath>

namespace froxel::builtin_scene {

MeshBuilder banner(float width, float length) {
    MeshBuilder hanging(Surface::kCloth);
    constexpr uint32_t kColumns = 6;
    constexpr uint32_t kRows = 8;
    // Folds deepen towards the free end; the tail is cut to two points.
    const auto cloth = [&](float s, float t) {
        const float tail = 0.16F * length * (1.0F - std::abs(s)) * t * t;
        const float fold =
            0.06F * t * std::sin(5.0F * s + 1.7F * t) + 0.03F * t * std::cos(2.3F * t + s);
        return glm::vec3(0.5F * width * s * (1.0F - 0.05F * t), -t * length + tail, 0.02F + fold);
    };
    const auto add = [&](float t0, float t1, uint32_t rows) {
        hanging.sheet(kColumns, rows, [&](uint32_t i, uint32_t j) {
            const float s = 2.0F * static_cast<float>(i) / kColumns - 1.0F;
            const float t = t1 + (t0 - t1) * static_cast<float>(j) / static_cast<float>(rows);
            constexpr float kStep = 0.01F;
            const glm::vec3 across = cloth(s + kStep, t) - cloth(s - kStep, t);
            const glm::vec3 up = cloth(s, t - kStep) - cloth(s, t + kStep);
            const glm::vec3 p = cloth(s, t);
            return Vertex{p, glm::normalize(glm::cross(across, up)), {p.x, t * length}};
        });
    };
    add(0.0F, 0.93F, kRows);
    hanging.use(Surface::kFringe);
    add(0.93F, 1.0F, 1);
    hanging.use(Surface::kGold);
    MeshBuilder rod(Surface::kGold);
    const float half = 0.5F * width + 0.08F;
    addLathe(rod,
             Profile({0.0F, -half - 0.06F})
                 .arc({0.02F, 0.09F}, 0.5F, 3)
                 .by({0.0F, 2.0F * half - 0.06F})
                 .arc({-0.02F, 0.09F}, 0.5F, 3),
             8);
    hanging.append(rod, turnedZ(-glm::half_pi<float>()));
    return hanging;
}

} // namespace froxel::builtin_scene
