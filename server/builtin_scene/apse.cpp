#include "builtin_scene/angles.h"
#include "builtin_scene/bay.h"
#include "builtin_scene/plan.h"
#include "builtin_scene/profile.h"

#include <cmath>
#include <vector>

namespace froxel::builtin_scene {
namespace {

constexpr uint32_t kAround = 40;
constexpr float kFloor = 0.45F;

float angleAt(uint32_t i) {
    return kPi * (static_cast<float>(i) / kAround - 0.5F);
}

// A moulding bent to the inside of the half cylinder; the profile's outward is towards the axis.
// Its ends show beside the jambs and are closed.
void addBand(MeshBuilder& mesh, const Profile& profile, float radius) {
    for (const auto& stretch : profile.stretches()) {
        const auto rows = static_cast<uint32_t>(stretch.size() - 1);
        mesh.sheet(kAround, rows, [&](uint32_t i, uint32_t j) {
            const Profile::Point& point = stretch[j];
            const float angle = angleAt(i);
            const glm::vec3 in(-std::cos(angle), 0, -std::sin(angle));
            return Vertex{in * (point.position.x - radius) + glm::vec3(0, point.position.y, 0),
                          in * point.normal.x + glm::vec3(0, point.normal.y, 0),
                          {angle * radius, -point.along_m}};
        });
    }
    const std::vector<glm::vec2>& points = profile.points();
    const float middle = 0.5F * (points.front().y + points.back().y);
    for (const uint32_t end : {0U, kAround}) {
        const float angle = angleAt(end);
        const glm::vec3 in(-std::cos(angle), 0, -std::sin(angle));
        const auto at = [&](glm::vec2 p) { return in * (p.x - radius) + glm::vec3(0, p.y, 0); };
        for (size_t k = 1; k < points.size(); ++k) {
            const bool first = end == 0;
            const glm::vec2 a = points[first ? k - 1 : k];
            const glm::vec2 b = points[first ? k : k - 1];
            if (a.x > 0 || b.x > 0) {
                mesh.polygon({at({0, middle}), at(a), at(b)});
            }
        }
    }
}

constexpr float kRadius = plan::kApseRadius + 0.02F;

// Marble revetment between three mouldings, cut into panels by pilasters.
void addRevetment(MeshBuilder& apse) {
    apse.use(Surface::kVerde);
    addBand(apse, Profile({0, 0.40F}).by({0, 1.3F}), kRadius);
    apse.use(Surface::kPavonazzetto);
    addBand(apse, Profile({0, 1.70F}).by({0, 2.50F}), kRadius);
    apse.use(Surface::kLimestone);
    addBand(apse, Profile({0.0F, 0.40F}).by({0.06F, 0.0F}).by({0.0F, 0.22F}).by({-0.06F, 0.03F}),
            kRadius);
    addBand(apse,
            Profile({0.0F, 1.62F})
                .by({0.05F, 0.0F})
                .arc({0.05F, 0.07F}, -0.4F, 3)
                .by({0, 0.04F})
                .by({-0.10F, 0.02F}),
            kRadius);
    addBand(apse,
            Profile({0.0F, 4.10F})
                .by({0.05F, 0.0F})
                .arc({0.10F, 0.12F}, -0.4F, 4)
                .by({0, 0.05F})
                .by({0.05F, 0.0F})
                .by({0, 0.08F})
                .by({-0.2F, 0.08F}),
            kRadius);
    // Flat pilasters of red marble cut the revetment into panels.
    apse.use(Surface::kRosso);
    for (uint32_t i = 0; i < 7; ++i) {
        MeshBuilder strip(Surface::kRosso);
        strip.box({-0.16F, 1.72F, -0.05F}, {0.16F, 4.15F, 0.05F}, 0.012F, kBack | kTop | kBottom);
        const float angle = kPi * (static_cast<float>(i) / 6.0F - 0.5F) * 0.94F;
        apse.append(strip, turnedY(-angle - 0.5F * kPi) * moved(0, 0, -kRadius));
    }
}

void addSemiDome(MeshBuilder& apse) {
    apse.use(Surface::kMosaic);
    constexpr uint32_t kRise = 20;
    apse.sheet(kAround, kRise, [&](uint32_t i, uint32_t j) {
        const float angle = angleAt(i);
        const float lift = 0.5F * kPi * static_cast<float>(j) / kRise;
        const float flat = j == kRise ? 0.0F : std::cos(lift);
        const glm::vec3 out(flat * std::cos(angle), std::sin(lift), flat * std::sin(angle));
        return Vertex{out * kRadius + glm::vec3(0, plan::kApseSpring, 0),
                      -out,
                      {angle * kRadius, -lift * kRadius}};
    });
}

// The floor, and three steps down to the nave.
void addFloor(MeshBuilder& apse) {
    apse.use(Surface::kInlay);
    std::vector<glm::vec3> rim;
    for (uint32_t i = 0; i <= kAround; ++i) {
        const float angle = angleAt(kAround - i);
        rim.emplace_back(kRadius * std::cos(angle), kFloor, kRadius * std::sin(angle));
    }
    apse.polygon(rim);
    apse.polygon({{-0.75F, kFloor, -kRadius},
                  {-0.75F, kFloor, kRadius},
                  {0, kFloor, kRadius},
                  {0, kFloor, -kRadius}});
    apse.use(Surface::kPavonazzetto);
    for (uint32_t i = 0; i < 3; ++i) {
        const auto step = static_cast<float>(i);
        const float y = 0.15F * (step + 1.0F) - (i == 2 ? 0.004F : 0.0F);
        const float half = 3.5F - 0.35F * step;
        apse.box({-1.70F + 0.36F * step, -0.02F, -half}, {-0.45F, y, half}, 0.018F,
                 kBottom | kRight);
    }
}

} // namespace

MeshBuilder apse() {
    MeshBuilder apse(Surface::kVerde);
    addRevetment(apse);
    addSemiDome(apse);
    addFloor(apse);
    MeshBuilder placed(Surface::kVerde);
    placed.append(apse, moved(plan::kHalfLength + plan::kEndWallDepth, 0, 0));
    return placed;
}

} // namespace froxel::builtin_scene
