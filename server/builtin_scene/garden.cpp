#include "builtin_scene/garden.h"

#include "builtin_scene/angles.h"
#include "builtin_scene/noise.h"
#include "builtin_scene/profile.h"

#include <algorithm>
#include <cmath>

namespace froxel::builtin_scene {
namespace {

// A stream of numbers in [0, 1), the same on every machine.
class Dice {
  public:
    explicit Dice(uint32_t seed) : seed_(seed) {}
    float next() { return randomAt(count_++, 17, seed_); }
    float between(float low, float high) { return low + (high - low) * next(); }

  private:
    uint32_t seed_;
    int32_t count_ = 0;
};

// A square spray of ivy whose middle is at `centre`; `out` is where it faces, also for shading, so
// that a mass of cards is lit as one soft body.
void addSpray(MeshBuilder& mesh, glm::vec3 centre, glm::vec3 out, float size, Dice& dice) {
    constexpr float kCard_m = 0.6F; // the texture's edge in uv metres
    const glm::vec3 shading = glm::normalize(out);
    const glm::vec3 tilt(dice.between(-0.5F, 0.5F), dice.between(-0.3F, 0.5F),
                         dice.between(-0.5F, 0.5F));
    const glm::vec3 facing = glm::normalize(shading + tilt);
    const glm::vec3 pole = std::abs(facing.y) < 0.95F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 level = glm::normalize(glm::cross(pole, facing));
    const glm::vec3 upright = glm::cross(facing, level);
    const float roll = dice.between(-0.9F, 0.9F);
    const glm::vec3 right = level * std::cos(roll) + upright * std::sin(roll);
    const glm::vec3 up = glm::cross(facing, right);
    const auto corner = [&](float x, float y) {
        const glm::vec3 offset = (right * x + up * y) * (0.5F * size);
        const glm::vec3 bulge = glm::normalize(shading + (right * x + up * y) * 0.35F);
        return mesh.vertex(
            {centre + offset, bulge, glm::vec2(0.5F + 0.49F * x, 0.5F - 0.49F * y) * kCard_m});
    };
    const uint32_t a = corner(-1, -1);
    const uint32_t b = corner(1, -1);
    const uint32_t c = corner(1, 1);
    const uint32_t d = corner(-1, 1);
    mesh.quad(a, b, c, d);
}

// A frond that rises from the origin towards +x and droops.
void addFrond(MeshBuilder& mesh, const glm::mat4& place, float length, float droop) {
    constexpr float kCard_m = 0.8F;
    constexpr uint32_t kSteps = 4;
    MeshBuilder frond(Surface::kFern);
    const float half = 0.27F * length;
    const auto spine = [&](float t) {
        const float angle = 1.15F - droop * t; // of the stalk against the ground
        const float radius = length / droop;
        return glm::vec2(radius * (std::sin(1.15F) - std::sin(angle)),
                         radius * (std::cos(angle) - std::cos(1.15F)));
    };
    frond.sheet(2, kSteps, [&](uint32_t i, uint32_t j) {
        const float t = static_cast<float>(j) / kSteps;
        const float s = static_cast<float>(i) - 1.0F;
        const glm::vec2 p = spine(t);
        const float angle = 1.15F - droop * t;
        const glm::vec3 up(-std::sin(angle), std::cos(angle), 0); // off the spine
        // Leaflets hang a little from the stalk: a shallow roof.
        const glm::vec3 side(0, 0, s * half);
        const glm::vec3 normal = glm::normalize(up + glm::vec3(0, 0, 0.4F * s));
        return Vertex{glm::vec3(p.x, p.y, 0) + side - up * (0.10F * half * std::abs(s)), normal,
                      glm::vec2(0.5F + 0.49F * s, 0.99F - 0.98F * t) * kCard_m};
    });
    mesh.append(frond, place);
}

void addFern(MeshBuilder& mesh, glm::vec3 at, float size, uint32_t fronds, Dice& dice) {
    for (uint32_t i = 0; i < fronds; ++i) {
        const float turn = kTwoPi * (static_cast<float>(i) + dice.between(-0.3F, 0.3F)) /
                           static_cast<float>(fronds);
        const float length = size * dice.between(0.75F, 1.1F);
        addFrond(mesh, moved(at.x, at.y, at.z) * turnedY(turn), length, dice.between(0.9F, 1.9F));
    }
}

void addSoil(MeshBuilder& mesh, float radius, float y) {
    mesh.use(Surface::kSoil);
    std::vector<glm::vec3> rim;
    for (uint32_t i = 0; i < 12; ++i) {
        const float angle = kTwoPi * static_cast<float>(i) / 12.0F;
        rim.emplace_back(radius * std::cos(angle), y, -radius * std::sin(angle));
    }
    mesh.polygon(rim);
}

} // namespace

MeshBuilder pottedFern(uint32_t seed) {
    Dice dice(seed);
    MeshBuilder pot(Surface::kTerracotta);
    addLathe(pot,
             Profile({0.17F, 0.0F})
                 .arc({0.09F, 0.36F}, 0.15F, 4)
                 .by({0.03F, 0.01F})
                 .by({0.0F, 0.07F})
                 .by({-0.05F, 0.0F})
                 .by({-0.01F, -0.08F}),
             18);
    addSoil(pot, 0.24F, 0.38F);
    pot.use(Surface::kFern);
    addFern(pot, {0, 0.37F, 0}, 0.85F, 11, dice);
    return pot;
}

MeshBuilder pottedTree(uint32_t seed) {
    Dice dice(seed);
    MeshBuilder tree(Surface::kLimestone);
    addLathe(tree,
             Profile({0.34F, 0.0F})
                 .by({0.0F, 0.08F})
                 .by({-0.04F, 0.03F})
                 .arc({0.10F, 0.36F}, 0.2F, 4)
                 .arc({0.0F, 0.08F}, 0.9F, 3)
                 .by({-0.07F, 0.0F})
                 .by({-0.02F, -0.08F}),
             20);
    addSoil(tree, 0.36F, 0.48F);
    tree.use(Surface::kWood);
    addTube(tree, 5, 7, 0.045F, false, [](float t) {
        return glm::vec3(0.05F * std::sin(3.0F * t), 0.46F + 1.5F * t,
                         0.04F * std::sin(4.0F * t + 1.0F));
    });
    tree.use(Surface::kIvy);
    constexpr uint32_t kSprays = 110;
    for (uint32_t i = 0; i < kSprays; ++i) {
        // Even over a sphere, by the golden angle, jittered inward.
        const float z = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / kSprays;
        const float flat = std::sqrt(1.0F - z * z);
        const float turn = 2.39996F * static_cast<float>(i);
        const glm::vec3 out(flat * std::cos(turn), z, flat * std::sin(turn));
        const float radius = dice.between(0.42F, 0.62F);
        addSpray(tree, glm::vec3(0.02F, 2.22F, 0) + out * radius, out, dice.between(0.42F, 0.58F),
                 dice);
    }
    return tree;
}

MeshBuilder plantingBed(float width, float climb, uint32_t seed) {
    Dice dice(seed);
    constexpr float kDepth = 1.05F;
    constexpr float kHeight = 0.46F;
    const float half = 0.5F * width;
    MeshBuilder bed(Surface::kLimestone);
    bed.box({-half, -0.02F, kDepth - 0.16F}, {half, kHeight, kDepth}, 0.02F, kBottom);
    for (const float side : {-1.0F, 1.0F}) {
        const float outer = side * half;
        const float inner = side * (half - 0.16F);
        bed.box({std::min(inner, outer), -0.02F, -0.05F},
                {std::max(inner, outer), kHeight, kDepth - 0.15F}, 0.02F, kBottom | kBack | kFront);
    }
    bed.box({-half - 0.03F, kHeight - 0.005F, kDepth - 0.20F},
            {half + 0.03F, kHeight + 0.06F, kDepth + 0.04F}, 0.02F);
    bed.use(Surface::kSoil);
    bed.polygon({{-half, kHeight - 0.07F, kDepth - 0.1F},
                 {half, kHeight - 0.07F, kDepth - 0.1F},
                 {half, kHeight - 0.07F, -0.05F},
                 {-half, kHeight - 0.07F, -0.05F}});
    bed.use(Surface::kFern);
    const auto ferns = static_cast<uint32_t>(width / 0.62F);
    for (uint32_t i = 0; i < ferns; ++i) {
        const float x = -half + width * (static_cast<float>(i) + 0.5F) / static_cast<float>(ferns);
        addFern(bed, {x + dice.between(-0.12F, 0.12F), kHeight - 0.08F, dice.between(0.40F, 0.66F)},
                dice.between(0.55F, 0.9F), 8, dice);
    }
    bed.use(Surface::kIvy);
    // Denser near the ground; above the sill only beside the window.
    constexpr float kBesideWindow = 1.38F;
    constexpr float kSill = 1.3F;
    const auto sprays = static_cast<uint32_t>(width * climb * 9.0F);
    for (uint32_t i = 0; i < sprays; ++i) {
        const float rise = dice.next();
        const float y = kHeight + climb * rise * rise;
        const float across = dice.between(-1.0F, 1.0F);
        const float x =
            y < kSill ? across * half
                      : std::copysign(kBesideWindow, across) + across * (half - kBesideWindow);
        addSpray(bed, {x, y, dice.between(0.03F, 0.14F)}, {0, 0, 1}, dice.between(0.34F, 0.55F),
                 dice);
    }
    return bed;
}

MeshBuilder ivyOnColumn(uint32_t seed) {
    Dice dice(seed);
    MeshBuilder ivy(Surface::kWood);
    const auto path = [](float t) {
        const float angle = kTwoPi * 1.6F * t;
        const float radius = 0.375F - 0.03F * t;
        return glm::vec3(radius * std::cos(angle), 0.1F + 2.75F * t, -radius * std::sin(angle));
    };
    addTube(ivy, 26, 4, 0.018F, false, path);
    ivy.use(Surface::kIvy);
    constexpr uint32_t kSprays = 70;
    for (uint32_t i = 0; i < kSprays; ++i) {
        const float t = (static_cast<float>(i) + dice.next()) / kSprays;
        const glm::vec3 on = path(t);
        const glm::vec3 out(on.x, 0, on.z);
        const glm::vec3 jitter(0, dice.between(-0.16F, 0.12F), 0);
        addSpray(ivy, on + out * 0.12F + jitter, out,
                 dice.between(0.24F, 0.38F) * (1.15F - 0.4F * t), dice);
    }
    return ivy;
}

MeshBuilder ivyCurtain(float width, float drop, uint32_t seed) {
    Dice dice(seed);
    MeshBuilder ivy(Surface::kIvy);
    const auto strands = static_cast<uint32_t>(width / 0.26F);
    for (uint32_t i = 0; i < strands; ++i) {
        const float x =
            width * ((static_cast<float>(i) + dice.next()) / static_cast<float>(strands) - 0.5F);
        const float length = drop * (0.25F + 0.75F * dice.next() * dice.next());
        const auto count = static_cast<uint32_t>(2.0F + length / 0.24F);
        for (uint32_t k = 0; k < count; ++k) {
            const float y = 0.10F - length * static_cast<float>(k) / static_cast<float>(count);
            addSpray(ivy, {x + dice.between(-0.08F, 0.08F), y, dice.between(0.03F, 0.12F)},
                     {0, 0.15F, 1}, dice.between(0.26F, 0.40F), dice);
        }
    }
    return ivy;
}

} // namespace froxel::builtin_scene
