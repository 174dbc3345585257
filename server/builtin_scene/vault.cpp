#include "builtin_scene/vault.h"

#include "builtin_scene/angles.h"
#include "builtin_scene/plan.h"
#include "builtin_scene/profile.h"
#include "builtin_scene/wall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace froxel::builtin_scene {
namespace {

constexpr float kRibHalf = 0.35F;
constexpr uint32_t kRows = 9; // coffers across the vault; the fifth is the crown
constexpr uint32_t kColumns = 3;

// Length of the vault's arc across the nave.
float arcLength() {
    return 2.0F * plan::kVaultRadius * std::asin(plan::kVaultHalfSpan / plan::kVaultRadius);
}

// Bends a flat ceiling (y up is thickness, z across) to the barrel.
glm::vec3 toBarrel(glm::vec3 p) {
    const float centre_y = plan::kVaultSpring + plan::kVaultRise - plan::kVaultRadius;
    const float angle = p.z / plan::kVaultRadius;
    const float radius = plan::kVaultRadius + p.y;
    return {p.x, centre_y + radius * std::cos(angle), radius * std::sin(angle)};
}

struct Cell {
    float x0, x1, z0, z1;
};

// Corners of a cell inset on all sides, clockwise from above, which is outward seen from below.
std::array<glm::vec3, 4> insetCorners(const Cell& c, float inset, float y) {
    return {glm::vec3(c.x0 + inset, y, c.z0 + inset), glm::vec3(c.x1 - inset, y, c.z0 + inset),
            glm::vec3(c.x1 - inset, y, c.z1 - inset), glm::vec3(c.x0 + inset, y, c.z1 - inset)};
}

void addFrame(MeshBuilder& mesh, const Cell& cell, glm::vec2 outer, glm::vec2 inner) {
    const auto a = insetCorners(cell, outer.x, outer.y);
    const auto b = insetCorners(cell, inner.x, inner.y);
    for (size_t i = 0; i < 4; ++i) {
        const size_t next = (i + 1) % 4;
        mesh.polygon({a[i], a[next], b[next], b[i]});
    }
}

// The ground of a coffer, its texture fitted to the cell.
void addGround(MeshBuilder& mesh, const Cell& cell, float inset, float y, float texture_m) {
    const auto corners = insetCorners(cell, inset, y);
    std::array<uint32_t, 4> at{};
    for (size_t i = 0; i < 4; ++i) {
        const glm::vec2 unit(i == 1 || i == 2 ? 1.0F : 0.0F, i < 2 ? 1.0F : 0.0F);
        at[i] = mesh.vertex({corners[i], {0, -1, 0}, unit * texture_m});
    }
    mesh.quad(at[0], at[1], at[2], at[3]);
}

void addCoffer(MeshBuilder& mesh, const Cell& cell) {
    mesh.use(Surface::kLimestone);
    addFrame(mesh, cell, {0, 0}, {0.13F, 0});
    addFrame(mesh, cell, {0.13F, 0}, {0.16F, 0.10F});
    addFrame(mesh, cell, {0.16F, 0.10F}, {0.225F, 0.10F});
    mesh.use(Surface::kGold);
    addFrame(mesh, cell, {0.225F, 0.10F}, {0.255F, 0.13F});
    mesh.use(Surface::kLimestone);
    addFrame(mesh, cell, {0.255F, 0.13F}, {0.27F, 0.22F});
    mesh.use(Surface::kStars);
    addGround(mesh, cell, 0.27F, 0.22F, 0.7F);
}

void addSkylight(MeshBuilder& mesh, const Cell& cell) {
    mesh.use(Surface::kLimestone);
    addFrame(mesh, cell, {0, 0}, {0.13F, 0});
    addFrame(mesh, cell, {0.13F, 0}, {0.16F, 0.30F});
    mesh.use(Surface::kSky);
    addGround(mesh, cell, 0.16F, 0.30F, 1.0F);
    mesh.use(Surface::kBronze);
    const float x = 0.5F * (cell.x0 + cell.x1);
    const float z = 0.5F * (cell.z0 + cell.z1);
    mesh.box({x - 0.025F, 0.14F, cell.z0 + 0.12F}, {x + 0.025F, 0.20F, cell.z1 - 0.12F}, 0.006F);
    mesh.box({cell.x0 + 0.12F, 0.14F, z - 0.025F}, {cell.x1 - 0.12F, 0.20F, z + 0.025F}, 0.006F);
}

// A round opening in the crown, three coffers by three wide, with a bronze wheel.
void addOculus(MeshBuilder& mesh, float half_x, float half_z) {
    const float radius = 0.86F * std::min(half_x, half_z);
    const Opening eye = roundOpening(0, 0, radius, 24);
    // The wall's x runs across the vault so that its narrow strips follow the bend.
    MeshBuilder panel(Surface::kLimestone);
    addWall(
        panel, -half_z, half_z, [=](float) { return -half_x; }, [=](float) { return half_x; },
        {eye});
    addReveal(panel, eye, 0.5F);
    MeshBuilder moulding(Surface::kGold);
    addTube(moulding, 48, 6, 0.06F, true, [&](float t) {
        return glm::vec3(radius * std::cos(2 * kPi * t), radius * std::sin(2 * kPi * t), 0.02F);
    });
    panel.append(moulding, glm::mat4(1.0F));
    panel.use(Surface::kBronze);
    for (uint32_t i = 0; i < 4; ++i) {
        MeshBuilder bar(Surface::kBronze);
        bar.box({-radius, -0.03F, -0.24F}, {radius, 0.03F, -0.16F}, 0.008F, kLeft | kRight);
        panel.append(bar, turnedZ(kPi * static_cast<float>(i) / 4.0F));
    }
    addTube(panel, 32, 6, 0.035F, true, [&](float t) {
        const float r = 0.5F * radius;
        return glm::vec3(r * std::cos(2 * kPi * t), r * std::sin(2 * kPi * t), -0.2F);
    });
    panel.use(Surface::kSky);
    panel.polygon({{-radius, -radius, -0.48F},
                   {radius, -radius, -0.48F},
                   {radius, radius, -0.48F},
                   {-radius, radius, -0.48F}});
    panel.use(Surface::kGlass);
    panel.polygon({{-radius, -radius, -0.30F},
                   {radius, -radius, -0.30F},
                   {radius, radius, -0.30F},
                   {-radius, radius, -0.30F}});
    // (x, y, z) of the panel to (z, x, -y): its front looks down.
    mesh.append(panel,
                glm::mat4(glm::mat3(glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, -1, 0))));
}

// A quarter-ellipse web of a groin vault: the part of a barrel along z, of half span `a` in x, that
// lies beyond the diagonals towards +z, where the bay ends at `b`.
void addWeb(MeshBuilder& mesh, float a, float b, float rise, const glm::mat4& place) {
    MeshBuilder web = mesh.fresh();
    constexpr uint32_t kAcross = 12;
    constexpr uint32_t kAlong = 2;
    web.sheet(kAcross, kAlong, [&](uint32_t i, uint32_t j) {
        const float angle = kPi * (static_cast<float>(i) / kAcross - 0.5F);
        const float s = i == 0 ? -1.0F : i == kAcross ? 1.0F : std::sin(angle);
        const float m = std::abs(s);
        const float t = static_cast<float>(j) / kAlong;
        const glm::vec3 position(a * s, rise * std::sqrt(std::max(0.0F, 1.0F - s * s)),
                                 b * (j == kAlong ? 1.0F : m + (1.0F - m) * t));
        const glm::vec3 normal =
            glm::normalize(glm::vec3(-position.x / (a * a), -position.y / (rise * rise), 0));
        return Vertex{position, normal, {angle * 0.5F * (a + rise), -position.z}};
    });
    mesh.append(web, place);
}

} // namespace

MeshBuilder barrelRib() {
    MeshBuilder rib(Surface::kLimestone);
    const float half = 0.5F * arcLength();
    const Profile profile = Profile({-kRibHalf, 0.05F})
                                .by({0.0F, -0.11F})
                                .by({0.05F, 0.0F})
                                .arc({0.05F, -0.06F}, -0.4F, 2)
                                .by({0.5F, 0.0F})
                                .arc({0.05F, 0.06F}, -0.4F, 2)
                                .by({0.05F, 0.0F})
                                .by({0.0F, 0.11F});
    constexpr uint32_t kSteps = 24;
    for (const auto& stretch : profile.stretches()) {
        const auto columns = static_cast<uint32_t>(stretch.size() - 1);
        rib.sheet(columns, kSteps, [&](uint32_t i, uint32_t j) {
            const Profile::Point& point = stretch[i];
            const float z = half * (2.0F * static_cast<float>(j) / kSteps - 1.0F);
            return Vertex{{point.position.x, point.position.y, z},
                          {point.normal.x, point.normal.y, 0},
                          {point.along_m, -z}};
        });
    }
    rib.use(Surface::kGold);
    for (uint32_t i = 0; i < kRows; ++i) {
        MeshBuilder boss(Surface::kGold);
        addLathe(boss, Profile({0.16F, 0.0F}).by({-0.04F, 0.05F}).by({-0.12F, 0.03F}), 10);
        const float z = half * (2.0F * (static_cast<float>(i) + 0.5F) / kRows - 1.0F);
        rib.append(boss, moved(0, -0.115F, z) * turnedX(kPi));
    }
    rib.warp(toBarrel);
    return rib;
}

MeshBuilder barrelBay(Crown crown) {
    MeshBuilder bay(Surface::kLimestone);
    const float half_x = 0.5F * plan::kBay - kRibHalf + 0.02F;
    const float pitch_x = 2.0F * half_x / kColumns;
    const float pitch_z = arcLength() / kRows;
    for (uint32_t row = 0; row < kRows; ++row) {
        const bool middle = row == kRows / 2;
        const bool eye = crown == Crown::kOculus && row + 1 >= kRows / 2 && row <= kRows / 2 + 1;
        for (uint32_t column = 0; column < kColumns && !eye; ++column) {
            const float x = -half_x + pitch_x * static_cast<float>(column);
            const float z = pitch_z * (static_cast<float>(row) - 0.5F * kRows);
            const Cell cell{x, x + pitch_x, z, z + pitch_z};
            middle&& crown == Crown::kSkylight ? addSkylight(bay, cell) : addCoffer(bay, cell);
        }
    }
    if (crown == Crown::kOculus) {
        addOculus(bay, half_x, 1.5F * pitch_z);
    }
    bay.warp(toBarrel);
    return bay;
}

MeshBuilder groinBay() {
    MeshBuilder bay(Surface::kPlaster);
    constexpr float kHalfX = 1.95F;
    constexpr float kHalfZ = 1.80F;
    constexpr float kRise = 2.05F;
    for (const float side : {0.0F, kPi}) {
        addWeb(bay, kHalfX, kHalfZ, kRise, turnedY(side));
        addWeb(bay, kHalfZ, kHalfX, kRise, turnedY(side + 0.5F * kPi));
    }
    bay.use(Surface::kLimestone);
    for (const float side : {-1.0F, 1.0F}) {
        addTube(bay, 14, 4, 0.075F, false, [&](float t) {
            const float angle = kPi * (0.5F - t);
            return glm::vec3(kHalfX * std::sin(angle), kRise * std::cos(angle),
                             side * kHalfZ * std::sin(angle));
        });
    }
    MeshBuilder boss(Surface::kGold);
    addLathe(boss, Profile({0.24F, 0.0F}).by({-0.06F, 0.10F}).arc({-0.18F, 0.06F}, 0.12F, 2), 12);
    bay.append(boss, moved(0, kRise, 0) * turnedX(kPi));
    return bay;
}

MeshBuilder aisleArch() {
    MeshBuilder arch(Surface::kLimestone);
    addRing(arch, {.radius = 1.5F,
                   .height = 0.66F,
                   .half_depth = 0.31F,
                   .count = 11,
                   .keystone = false,
                   .omit = kTop});
    MeshBuilder turned(Surface::kLimestone);
    turned.append(arch, turnedY(0.5F * kPi));
    return turned;
}

} // namespace froxel::builtin_scene
