// Pictures of the built-in scene against committed ones that a person has looked at.
// FROXEL_UPDATE_GOLDEN=1 writes them anew: look at each before committing it, and say why.
#include "encode/image_file.h"
#include "hall/hall.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/image_compare.h"

#include <cstdlib>

namespace froxel::test {

namespace {

// One driver version is pinned, but its code follows the processor's vector units.
constexpr double kMaxRmse = 0.6;
constexpr double kMaxShareAbove8 = 0.002;

class Golden : public GpuTest {};

} // namespace

TEST_F(Golden, EveryRenderer_BuiltinScene_LooksAsCommitted) {
    const auto scene = hall::makeHall();
    render::Renderer renderer(device(), scene);
    for (size_t kind = 0; kind < view::kRendererNames.size(); ++kind) {
        const std::string name(view::kRendererNames[kind]);
        SCOPED_TRACE(name);
        render::FrameInputs inputs;
        inputs.settings.camera = scene.cameras.front().camera;
        inputs.settings.size = {320, 180};
        inputs.settings.renderer = static_cast<view::Renderer>(kind);
        inputs.settings.lights.count = 300;
        inputs.time_s = 5;
        const Picture picture = draw(renderer, inputs);
        const auto path = std::filesystem::path(FROXEL_GOLDEN_DIR) / ("hall_" + name + ".png");
        if (std::getenv("FROXEL_UPDATE_GOLDEN") != nullptr) {
            const PixelView pixels{picture.rgba8.data(), 320, 180, size_t{4} * 320};
            ASSERT_TRUE(encode::writeImage(path, pixels, {}));
            continue;
        }
        const auto golden = readPng(path);
        ASSERT_TRUE(golden) << path << " is missing";
        ASSERT_EQ(golden->width_px, 320U);
        ASSERT_EQ(golden->height_px, 180U);
        const auto difference = compare(*golden, picture.rgba8);
        EXPECT_LT(difference.rmse, kMaxRmse);
        EXPECT_LT(difference.share_above_8, kMaxShareAbove8);
    }
}

} // namespace froxel::test
