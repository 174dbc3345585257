// One frame, drawn and read back.
#pragma once

#include "render/view/renderer.h"

#include <cstring>
#include <string_view>
#include <vector>

namespace froxel::test {

struct Picture {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::vector<std::byte> rgba8;
    std::vector<float> radiance; // [height][width][3]
    FrameStats stats;
};

// Fails the test and returns an empty picture on an error.
[[nodiscard]] Picture draw(render::ViewRenderer& view, render::FrameInputs inputs);
[[nodiscard]] Picture draw(render::Renderer& renderer, const render::FrameInputs& inputs);

// With its radiance only where the inputs ask for it: debug views have none.
[[nodiscard]] Picture drawPixels(render::ViewRenderer& view, const render::FrameInputs& inputs);

// Of the frame that was submitted.
[[nodiscard]] Picture collectPixels(render::ViewRenderer& view);

[[nodiscard]] bool hasPass(const Picture& picture, std::string_view name);

// Floats whose bits differ; every float where the sizes do.
[[nodiscard]] size_t differingFloats(const Picture& a, const Picture& b);

} // namespace froxel::test
