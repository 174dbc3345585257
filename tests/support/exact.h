// What every hard case asks of a frame.
#pragma once

#include "core/visibility.h"
#include "render/view/renderer.h"
#include "support/draw.h"

namespace froxel::test {

// 64 x 36 pixels from the origin along -Z at 60 degrees, lists asked for, no seeded lights, no
// ambient light, lambert.
[[nodiscard]] render::FrameInputs hardInputs();

// Some of them are empty where they were not asked for.
struct ExactPictures {
    Picture naive;
    Picture forward_plus;
    Picture deferred; // by lists
};

enum class Toon { kNo, kToo };

// Draws by every renderer. forward_plus is naive, and the deferred ones by lists are by all lights,
// bit for bit; every float is finite, unless a test says that infinity is right.
ExactPictures
expectExact(render::ViewRenderer& view, render::FrameInputs inputs, Toon toon = Toon::kToo);
ExactPictures
expectExact(render::Renderer& renderer, const render::FrameInputs& inputs, Toon toon = Toon::kToo);

// naive by ids that compute rasters: positions from the triangles' planes, as a GPU has them by
// default.
[[nodiscard]] Picture drawByPlanes(render::Renderer& renderer, render::FrameInputs inputs);

[[nodiscard]] size_t nonFinite(const Picture& picture);
// Pixels with a channel above `least`.
[[nodiscard]] size_t litPixels(const Picture& picture, float least = 0);
[[nodiscard]] float largest(const Picture& picture);

// A pixel's channel, and all of them.
[[nodiscard]] float at(const Picture& picture, uint32_t x, uint32_t y, uint32_t channel);
[[nodiscard]] inline glm::dvec3 colorAt(const Picture& picture, uint32_t x, uint32_t y) {
    return {at(picture, x, y, 0), at(picture, x, y, 1), at(picture, x, y, 2)};
}

} // namespace froxel::test
