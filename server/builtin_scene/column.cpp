#include "builtin_scene/column.h"

#include "builtin_scene/angles.h"
#include "builtin_scene/profile.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace froxel::builtin_scene {
namespace {

// Attic base: two tori with a scotia between, for a shaft of `radius`.
Profile atticBase(float radius, float bottom) {
    const float s = radius / 0.36F;
    return Profile({0.46F * s, bottom})
        .arc({0.0F, 0.13F * s}, 0.95F, 4)
        .by({-0.025F * s, 0.0F})
        .by({0.0F, 0.02F * s})
        .arc({-0.02F * s, 0.07F * s}, -0.7F, 2)
        .by({0.0F, 0.02F * s})
        .arc({-0.005F * s, 0.08F * s}, 0.9F, 3)
        .by({-0.02F * s, 0.0F})
        .by({-0.03F * s, 0.05F * s});
}

// Plan of a fluted shaft of unit radius: hollows between narrow fillets.
Profile flutedPlan(uint32_t flutes) {
    const float pitch = kTwoPi / static_cast<float>(flutes);
    const auto at = [](float angle) { return glm::vec2(std::cos(angle), std::sin(angle)); };
    Profile plan(at(0));
    for (uint32_t i = 0; i < flutes; ++i) {
        const float start = pitch * static_cast<float>(i);
        const glm::vec2 fillet = at(start + 0.24F * pitch);
        const glm::vec2 end = i + 1 == flutes ? at(0) : at(start + pitch);
        plan.to(fillet);
        plan.arc(end - fillet, -0.75F, 3);
    }
    return plan;
}

// Entasis: the shaft keeps its width for a third, then narrows by a sixth along a soft curve.
float entasis(float t) {
    const float rise = std::max(0.0F, (t - 0.33F) / 0.67F);
    return 1.0F - 0.155F * rise * rise * (1.0F - 0.25F * rise);
}

// One acanthus leaf in the plane z = 0 against y up, curling towards +z; unit height.
MeshBuilder acanthus(float width) {
    MeshBuilder leaf(Surface::kLimestone);
    const auto surface = [&](float s, float t) {
        // Full up to the lip, which is blunt.
        const float full = width * (0.80F + 0.20F * std::sin(kPi * t));
        const float half = full * std::sqrt(std::max(0.0F, 1.0F - t * t * t * t * t * t));
        const float curl = std::max(0.0F, t - 0.45F) / 0.55F;
        const float bend = 1.9F * curl * curl;
        const float x = s * half;
        // Up the bell, then over: an arc of radius 0.29 takes the upper half.
        const float y = std::min(t, 0.45F) + 0.29F * std::sin(bend);
        const float z = 0.05F + 0.10F * t + 0.29F * (1.0F - std::cos(bend));
        const float fold = 0.07F * (1.0F - std::abs(s)) - 0.10F * s * s;
        return glm::vec3(x, y - fold * std::sin(bend), z + fold * std::cos(bend));
    };
    const auto normal = [&](float s, float t) {
        constexpr float kStep = 0.02F;
        const glm::vec3 across = surface(s + kStep, t) - surface(s - kStep, t);
        const glm::vec3 up = surface(s, t + kStep) - surface(s, t - kStep);
        return glm::normalize(glm::cross(across, up));
    };
    const auto make = [&](uint32_t columns, uint32_t rows, bool back) {
        leaf.sheet(columns, rows, [&](uint32_t i, uint32_t j) {
            const float s =
                2.0F * static_cast<float>(back ? columns - i : i) / static_cast<float>(columns) -
                1.0F;
            // Rows crowd towards the curl.
            const float left = 1.0F - static_cast<float>(j) / static_cast<float>(rows);
            const float t = 0.985F * (1.0F - left * std::sqrt(left));
            const glm::vec3 n = normal(s, t) * (back ? -1.0F : 1.0F);
            const glm::vec3 p = surface(s, t);
            return Vertex{p, n, {(back ? -p.x : p.x), -t}};
        });
    };
    make(4, 5, false);
    make(2, 4, true);
    return leaf;
}

// A spiral scroll seen from the front (+z), of unit radius.
MeshBuilder volute() {
    MeshBuilder scroll(Surface::kLimestone);
    addTube(scroll, 15, 3, 0.17F, false, [](float t) {
        const float angle = 0.5F * kPi - t * 1.6F * kTwoPi;
        const float radius = 0.85F * (1.0F - 0.80F * t);
        return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0.12F * t);
    });
    MeshBuilder eye(Surface::kLimestone);
    addLathe(eye, Profile({0.26F, 0.0F}).by({-0.26F, 0.20F}), 6);
    scroll.append(
        eye, glm::mat4(glm::mat3(glm::vec3(1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, -1, 0))));
    return scroll;
}

glm::mat4 scaled(float x, float y, float z) {
    glm::mat4 m(1.0F);
    m[0].x = x;
    m[1].y = y;
    m[2].z = z;
    return m;
}

// From the shaft's neck at y = 0 to the top of the abacus at y = 0.62.
void addCapital(MeshBuilder& column, float y) {
    MeshBuilder capital(Surface::kLimestone);
    addLathe(capital,
             Profile({0.305F, -0.05F})
                 .arc({0.0F, 0.06F}, 0.8F, 3)
                 .by({-0.01F, 0.0F})
                 .by({0.01F, 0.25F})
                 .arc({0.12F, 0.22F}, -0.2F, 2)
                 .by({0.0F, 0.03F}),
             16);
    const MeshBuilder leaf = acanthus(0.29F);
    for (uint32_t i = 0; i < 8; ++i) {
        const float angle = kTwoPi * static_cast<float>(i) / 8.0F;
        capital.append(leaf, turnedY(angle) * moved(0, 0.0F, 0.285F) * scaled(0.40F, 0.40F, 0.40F));
        capital.append(leaf, turnedY(angle + kPi / 8.0F) * moved(0, 0.02F, 0.275F) *
                                 scaled(0.46F, 0.66F, 0.52F));
    }
    const MeshBuilder scroll = volute();
    for (uint32_t i = 0; i < 4; ++i) {
        const float angle = kTwoPi * (static_cast<float>(i) + 0.5F) / 4.0F;
        const glm::mat4 corner = turnedY(angle) * moved(0, 0.44F, 0.49F);
        // Two scrolls back to back on each corner, a little apart.
        capital.append(scroll, corner * turnedY(0.5F * kPi) * moved(-0.01F, 0, 0.03F) *
                                   scaled(0.125F, 0.125F, 0.25F));
        capital.append(scroll, corner * turnedY(-0.5F * kPi) * moved(0.01F, 0, 0.03F) *
                                   scaled(-0.125F, 0.125F, 0.25F));
    }
    capital.box({-0.47F, 0.53F, -0.47F}, {0.47F, 0.575F, 0.47F}, 0.012F);
    capital.box({-0.50F, 0.575F, -0.50F}, {0.50F, 0.65F, 0.50F}, 0.015F);
    column.append(capital, moved(0, y, 0));
}

} // namespace

MeshBuilder naveColumn() {
    MeshBuilder column(Surface::kLimestone);
    column.box({-0.50F, -0.02F, -0.50F}, {0.50F, 0.16F, 0.50F}, 0.015F, kBottom);
    column.append(
        [] {
            MeshBuilder base(Surface::kLimestone);
            addLathe(base, atticBase(0.36F, 0.16F), 20);
            return base;
        }(),
        glm::mat4(1.0F));

    column.use(Surface::kPavonazzetto);
    constexpr float kFoot = 0.50F;
    constexpr float kNeck = 2.76F;
    std::vector<glm::vec2> rings;
    for (uint32_t i = 0; i <= 3; ++i) {
        const float t = static_cast<float>(i) / 3.0F;
        rings.emplace_back(0.355F * entasis(t), kFoot + (kNeck - kFoot) * t);
    }
    addLoft(column, flutedPlan(16), rings);
    addCapital(column, kNeck);
    return column;
}

MeshBuilder galleryColumn(Surface shaft) {
    MeshBuilder column(Surface::kLimestone);
    column.box({-0.20F, -0.02F, -0.20F}, {0.20F, 0.08F, 0.20F}, 0.010F, kBottom);
    addLathe(column,
             Profile({0.18F, 0.08F})
                 .arc({0.0F, 0.06F}, 0.9F, 3)
                 .by({-0.02F, 0.0F})
                 .by({-0.01F, 0.04F})
                 .by({-0.005F, 0.04F}),
             14);
    column.use(shaft);
    Profile body({0.142F, 0.20F});
    for (uint32_t i = 1; i <= 3; ++i) {
        const float t = static_cast<float>(i) / 3.0F;
        body.to({0.142F * entasis(t), 0.20F + 1.38F * t});
    }
    addLathe(column, body, 14);
    column.use(Surface::kLimestone);
    addLathe(column, Profile({0.125F, 1.55F}).arc({0.0F, 0.05F}, 0.9F, 3), 14);
    // The cushion: a circle below grows into the abacus' square.
    constexpr uint32_t kAround = 24;
    constexpr uint32_t kRows = 3;
    const auto surface = [](float turn, float t) {
        const float c = std::cos(turn);
        const float s = std::sin(turn);
        const float square = 1.0F / std::max(std::abs(c), std::abs(s));
        const float ease = t * t * (3.0F - 2.0F * t);
        const float radius =
            (0.125F + 0.095F * std::sin(0.5F * kPi * t)) * (1.0F + (square - 1.0F) * ease * 0.95F);
        return glm::vec3(radius * c, 1.60F + 0.28F * t, -radius * s);
    };
    column.sheet(kAround, kRows, [&](uint32_t i, uint32_t j) {
        const float turn = i == kAround ? 0.0F : kTwoPi * static_cast<float>(i) / kAround;
        const float t = static_cast<float>(j) / kRows;
        const glm::vec3 across = surface(turn + 0.01F, t) - surface(turn - 0.01F, t);
        const glm::vec3 up = surface(turn, t + 0.01F) - surface(turn, t - 0.01F);
        return Vertex{surface(turn, t),
                      glm::normalize(glm::cross(across, up)),
                      {static_cast<float>(i) / kAround, -0.3F * t}};
    });
    column.box({-0.23F, 1.87F, -0.23F}, {0.23F, 2.0F, 0.23F}, 0.014F);
    return column;
}

MeshBuilder wallPilaster() {
    MeshBuilder pilaster(Surface::kLimestone);
    pilaster.box({-0.42F, -0.02F, -0.05F}, {0.42F, 0.22F, 0.26F}, 0.015F, kBottom | kBack);
    pilaster.box({-0.37F, 0.20F, -0.05F}, {0.37F, 0.30F, 0.22F}, 0.03F, kBottom | kBack);
    pilaster.use(Surface::kGiallo);
    pilaster.box({-0.32F, 0.28F, -0.05F}, {0.32F, 2.95F, 0.18F}, 0.010F, kBottom | kTop | kBack);
    pilaster.use(Surface::kLimestone);
    pilaster.box({-0.35F, 2.92F, -0.05F}, {0.35F, 3.00F, 0.21F}, 0.02F, kBack);
    pilaster.box({-0.38F, 3.00F, -0.05F}, {0.38F, 3.22F, 0.24F}, 0.05F, kBack);
    pilaster.box({-0.43F, 3.20F, -0.05F}, {0.43F, 3.42F, 0.30F}, 0.015F, kBack);
    return pilaster;
}

} // namespace froxel::builtin_scene
