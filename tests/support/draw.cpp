#include "support/draw.h"

#include "core/linear_image.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace froxel::test {

Picture collectPixels(render::ViewRenderer& view) {
    Picture picture;
    auto frame = view.collect();
    if (!frame) {
        ADD_FAILURE() << frame.error().message;
        return picture;
    }
    const PixelView& pixels = frame->pixels.view();
    picture.width_px = pixels.width_px;
    picture.height_px = pixels.height_px;
    picture.rgba8.assign(pixels.data, pixels.data + pixels.stride_bytes * pixels.height_px);
    if (pixels.output(Output::kRadiance) != nullptr) {
        picture.radiance = radianceOf(pixels).rgb;
    }
    picture.stats = frame->stats;
    return picture;
}

Picture drawPixels(render::ViewRenderer& view, const render::FrameInputs& inputs) {
    const auto submitted = view.submit(inputs);
    if (!submitted) {
        ADD_FAILURE() << submitted.error().message;
        return {};
    }
    return collectPixels(view);
}

Picture draw(render::ViewRenderer& view, render::FrameInputs inputs) {
    inputs.outputs = {Output::kRadiance};
    return drawPixels(view, inputs);
}

Picture draw(render::Renderer& renderer, const render::FrameInputs& inputs) {
    render::ViewRenderer view(renderer);
    return draw(view, inputs);
}

bool hasPass(const Picture& picture, std::string_view name) {
    const auto& passes = picture.stats.passes;
    return std::any_of(passes.begin(), passes.end(),
                       [&](const PassTime& pass) { return pass.name == name; });
}

size_t differingFloats(const Picture& a, const Picture& b) {
    if (a.radiance.size() != b.radiance.size()) {
        return std::max(a.radiance.size(), b.radiance.size());
    }
    size_t count = 0;
    for (size_t i = 0; i < a.radiance.size(); ++i) {
        count += std::memcmp(&a.radiance[i], &b.radiance[i], sizeof(float)) != 0 ? 1U : 0U;
    }
    return count;
}

} // namespace froxel::test
