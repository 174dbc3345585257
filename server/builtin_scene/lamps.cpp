#include "builtin_scene/angles.h"
#include "builtin_scene/furnishing.h"
#include "builtin_scene/profile.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace froxel::builtin_scene {
namespace {

constexpr uint32_t kSides = 6;

// A regular plan of unit radius with hard corners.
Profile hexagon() {
    const auto corner = [](uint32_t i) {
        const float angle = kTwoPi * static_cast<float>(i % kSides) / kSides;
        return glm::vec2(std::cos(angle), std::sin(angle));
    };
    Profile plan(corner(0));
    for (uint32_t i = 1; i <= kSides; ++i) {
        plan.to(corner(i));
    }
    return plan;
}

// A chain from y = top down to y = bottom: long links, each turned a quarter against the last.
void addChain(MeshBuilder& mesh, float top, float bottom) {
    constexpr float kLink = 0.36F;
    const auto count = static_cast<uint32_t>(std::ceil((top - bottom) / (kLink - 0.03F)));
    const float pitch = (top - bottom) / static_cast<float>(count);
    MeshBuilder link(Surface::kBronze);
    addTube(link, 8, 3, 0.011F, true, [&](float t) {
        const float angle = kTwoPi * t;
        return glm::vec3(0.035F * std::cos(angle), 0.5F * (pitch + 0.03F) * std::sin(angle), 0);
    });
    for (uint32_t i = 0; i < count; ++i) {
        const float y = top - pitch * (static_cast<float>(i) + 0.5F);
        mesh.append(link, moved(0, y, 0) * turnedY(i % 2 == 0 ? 0.0F : 0.25F * kTwoPi));
    }
}

// The body, its top ring at y = 0, 0.95 m high and 0.46 m wide at most.
MeshBuilder body() {
    MeshBuilder lamp(Surface::kBronze);
    const Profile plan = hexagon();
    addLoft(lamp, plan, {{0.03F, -0.12F}, {0.03F, 0.0F}});
    // The roof in two pitches, the floor and its finial; each ring hides the next one's edge.
    addLoft(lamp, plan, {{0.25F, -0.34F}, {0.25F, -0.30F}, {0.12F, -0.20F}, {0.05F, -0.06F}});
    addLoft(lamp, plan, {{0.07F, -0.84F}, {0.17F, -0.76F}, {0.17F, -0.73F}});
    MeshBuilder plates(Surface::kBronze);
    const auto plate = [&](float radius, float y, bool up) {
        std::vector<glm::vec3> rim;
        for (uint32_t i = 0; i < kSides; ++i) {
            const uint32_t step = up ? i : kSides - i;
            const float angle = kTwoPi * static_cast<float>(step % kSides) / kSides;
            rim.emplace_back(radius * std::cos(angle), y, -radius * std::sin(angle));
        }
        plates.polygon(rim);
    };
    plate(0.25F, -0.34F, false);
    plate(0.17F, -0.73F, true);
    lamp.append(plates, glm::mat4(1.0F));
    lamp.use(Surface::kGold);
    addLathe(lamp, Profile({0.0F, -0.95F}).arc({0.0F, 0.09F}, 0.9F, 4).by({0.07F, 0.03F}), 8);
    // Posts lean outward from floor to roof.
    for (uint32_t i = 0; i < kSides; ++i) {
        const float angle = kTwoPi * static_cast<float>(i) / kSides;
        const glm::vec3 out(std::cos(angle), 0, -std::sin(angle));
        MeshBuilder post(Surface::kBronze);
        addTube(post, 1, 4, 0.012F, false, [&](float t) {
            return out * (0.16F + 0.06F * t) + glm::vec3(0, -0.74F + 0.41F * t, 0);
        });
        lamp.append(post, glm::mat4(1.0F));
    }
    lamp.use(Surface::kFlame);
    addLathe(lamp,
             Profile({0.0F, -0.68F}).to({0.045F, -0.62F}).to({0.035F, -0.54F}).to({0.0F, -0.44F}),
             8);
    lamp.use(Surface::kGlass);
    addLoft(lamp, plan, {{0.155F, -0.74F}, {0.215F, -0.33F}});
    return lamp;
}

} // namespace

MeshBuilder lantern(float drop, float scale) {
    MeshBuilder whole(Surface::kBronze);
    if (drop > 0) {
        addChain(whole, 0.05F, -drop + 0.01F);
    }
    whole.append(body(), moved(0, -drop, 0) * glm::scale(glm::mat4(1.0F), glm::vec3(scale)));
    return whole;
}

} // namespace froxel::builtin_scene
