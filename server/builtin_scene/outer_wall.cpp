#include "builtin_scene/angles.h"
#include "builtin_scene/bay.h"
#include "builtin_scene/plan.h"
#include "builtin_scene/profile.h"
#include "builtin_scene/wall.h"

#include <algorithm>

namespace froxel::builtin_scene {
namespace {

constexpr float kHalf = 0.5F * plan::kBay;
constexpr float kGalleryCeiling = 9.5F;

struct Window {
    float radius, sill, spring;
};

// Stone frame, bronze lattice, a pane and the dusk behind; the wall's face is z = 0.
void addWindow(MeshBuilder& mesh, const Window& window, const Opening& opening) {
    constexpr float kDepth = 0.36F;
    mesh.use(Surface::kAshlar);
    addReveal(mesh, opening, kDepth);
    mesh.use(Surface::kLimestone);
    MeshBuilder ring(Surface::kLimestone);
    addRing(
        ring,
        {.radius = window.radius, .height = 0.26F, .half_depth = 0.05F, .count = 9, .omit = kBack});
    mesh.append(ring, moved(0, window.spring, 0));
    const float outer = window.radius + 0.22F;
    for (const float side : {-1.0F, 1.0F}) {
        const float inner_x = side * window.radius;
        const float outer_x = side * outer;
        mesh.box({std::min(inner_x, outer_x), window.sill, -0.05F},
                 {std::max(inner_x, outer_x), window.spring, 0.05F}, 0.012F,
                 kBack | kBottom | kTop);
    }
    mesh.box({-outer - 0.1F, window.sill - 0.16F, -0.3F}, {outer + 0.1F, window.sill, 0.16F}, 0.02F,
             kBack);
    const float top = window.spring + window.radius;
    const auto pane = [&](Surface surface, float z) {
        mesh.use(surface);
        mesh.polygon({{-window.radius, window.sill - 0.02F, z},
                      {window.radius, window.sill - 0.02F, z},
                      {window.radius, top, z},
                      {-window.radius, top, z}});
    };
    pane(Surface::kSky, -kDepth + 0.005F);
    pane(Surface::kGrille, -0.2F);
}

} // namespace

MeshBuilder outerBay() {
    MeshBuilder bay(Surface::kAshlar);
    const Window lower{0.85F, 1.5F, 2.9F};
    const Window upper{0.7F, 7.0F, 8.2F};
    const auto hole = [](const Window& w) {
        return archOpening(0, w.radius, w.sill, w.spring, 14);
    };
    addWall(bay, -kHalf, kHalf, level(0), level(plan::kGalleryFloor), {hole(lower)});
    addWall(bay, -kHalf, kHalf, level(plan::kGalleryFloor), level(kGalleryCeiling + 0.1F),
            {hole(upper)});
    addWindow(bay, lower, hole(lower));
    addWindow(bay, upper, hole(upper));

    // Marble dado: plinth, panel, rail.
    bay.use(Surface::kLimestone);
    bay.box({-kHalf, -0.02F, -0.05F}, {kHalf, 0.24F, 0.07F}, 0.015F,
            kLeft | kRight | kBack | kBottom);
    addMoulding(bay,
                Profile({0.0F, 1.10F})
                    .by({0.04F, 0.0F})
                    .by({0.0F, 0.03F})
                    .arc({0.05F, 0.06F}, -0.4F, 3)
                    .by({0.0F, 0.04F})
                    .to({0.0F, 1.25F}),
                -kHalf, kHalf);
    bay.use(Surface::kRosso);
    bay.box({-1.72F, 0.32F, -0.05F}, {1.72F, 1.02F, 0.035F}, 0.012F, kBack);
    bay.use(Surface::kVerde);
    bay.box({-1.35F, 0.42F, -0.05F}, {1.35F, 0.92F, 0.05F}, 0.010F, kBack);

    // Gallery: dado rail, floor, ceiling on beams.
    bay.use(Surface::kLimestone);
    bay.box({-kHalf, 5.98F, -0.05F}, {kHalf, 6.22F, 0.05F}, 0.012F,
            kLeft | kRight | kBack | kBottom);
    bay.use(Surface::kHerringbone);
    constexpr float kDepth = plan::kWallZ - plan::kColumnZ + 0.1F;
    bay.polygon({{-kHalf, plan::kGalleryFloor, kDepth},
                 {kHalf, plan::kGalleryFloor, kDepth},
                 {kHalf, plan::kGalleryFloor, -0.05F},
                 {-kHalf, plan::kGalleryFloor, -0.05F}});
    bay.use(Surface::kWood);
    bay.polygon({{-kHalf, kGalleryCeiling, -0.05F},
                 {kHalf, kGalleryCeiling, -0.05F},
                 {kHalf, kGalleryCeiling, kDepth},
                 {-kHalf, kGalleryCeiling, kDepth}});
    for (uint32_t i = 0; i < 4; ++i) {
        const float x = -kHalf + plan::kBay * (static_cast<float>(i) + 0.5F) / 4.0F;
        bay.box({x - 0.09F, kGalleryCeiling - 0.24F, -0.05F},
                {x + 0.09F, kGalleryCeiling + 0.02F, kDepth}, 0.015F, kTop | kBack | kFront);
    }
    MeshBuilder placed(Surface::kAshlar);
    placed.append(bay, moved(0, 0, -plan::kWallZ));
    return placed;
}

} // namespace froxel::builtin_scene
