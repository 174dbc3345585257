// Draws: what errors are taken from, on a device.
#include "bench/errors.h"
#include "bench/shown_picture.h"
#include "builtin_scene/hall.h"
#include "render/view/renderer.h"
#include "support/gpu_fixture.h"

#include <algorithm>
#include <cstdlib>

namespace froxel::bench {
namespace {

class BenchPictureTest : public test::SharedGpuTest {
  protected:
    BenchPictureTest() {
        base_.settings.size = {128, 72};
        base_.settings.lights.count = 40;
        base_.views = {{"Nave", scene_.cameras[0].camera, 0},
                       {"Arcade", scene_.cameras[2].camera, 5}};
        row_.settings = base_.settings;
        row_.settings.camera = base_.views[0].camera;
    }
    RowErrors measure(double limit) {
        ErrorMeter meter(renderer_, scene_, base_, {{128, 72}, limit, limit}, stop_);
        return meter.measure(row_);
    }

    scene::Scene scene_ = builtin_scene::makeHall();
    render::Renderer renderer_{device(), scene_};
    Base base_;
    Row row_;
    std::atomic<bool> stop_ = false;
};

TEST_F(BenchPictureTest, ShownPicture_OfTheDevicesRadiance_IsTheDevicesPicture) {
    Pictures pictures(renderer_, scene_);
    for (const auto& [tone_map, exposure] :
         {std::pair(settings::ToneMap::kPbrNeutral, 1.0F),
          {settings::ToneMap::kPbrNeutral, 16.0F}, // most of it beyond white
          {settings::ToneMap::kClamp, 1.0F}}) {
        row_.settings.tone_map = tone_map;
        row_.settings.exposure = exposure;
        const auto picture = pictures.draw(row_.settings, 0).value();
        const auto right = shownPicture(picture->linear, static_cast<double>(exposure), tone_map);
        ASSERT_EQ(picture->rgba8.size(), right.size());
        size_t differing = 0;
        for (size_t i = 0; i < right.size(); ++i) {
            const int step =
                std::to_integer<int>(right[i]) - std::to_integer<int>(picture->rgba8[i]);
            EXPECT_LE(std::abs(step), 1);
            differing += step != 0 ? 1U : 0U;
        }
        EXPECT_LT(differing, right.size() / 100) << "only what lies between two steps may differ";
    }
}

TEST_F(BenchPictureTest, Errors_R1IsExactAtEveryViewAndR2IsSmall) {
    const auto errors = measure(1e18);
    EXPECT_EQ(errors.r1.skipped, "");
    EXPECT_TRUE(errors.r1.exact());
    EXPECT_EQ(errors.r1.view_count, 2U);
    EXPECT_EQ(errors.r2.skipped, "");
    EXPECT_FALSE(errors.r2.exact());
    EXPECT_LT(errors.r2.linear.rmse, 0.05);
}

TEST_F(BenchPictureTest, Errors_PairsLimit_LeavesViewsOutAndSaysWhy) {
    const double pairs = 128.0 * 72 * (40 + static_cast<double>(scene_.lights.size()));
    EXPECT_EQ(measure(1.5 * pairs).r1.view_count, 1U);
    EXPECT_NE(measure(0.5 * pairs).r1.skipped, "");
}

// That a difference would be seen.
TEST_F(BenchPictureTest, Errors_OtherPictures_AreNotExact) {
    row_.settings.gbuffer.normal = settings::NormalEncoding::kXy16; // loses the sign of z
    const auto rough = measure(1e18);
    EXPECT_TRUE(rough.r1.exact()) << "R1 has the same G-buffer";
    row_.settings.gbuffer = {};
    EXPECT_GT(rough.r2.linear.rmse, 1.5 * measure(1e18).r2.linear.rmse);
}

TEST_F(BenchPictureTest, Stopped_Errors_AreSkipped) {
    stop_ = true;
    EXPECT_NE(measure(1e18).r1.skipped, "");
}

} // namespace
} // namespace froxel::bench
