// Times of frames and passes on the device, and what is made of a driver that does not tell them.
#include "render/view/device_speed.h"
#include "render/view/renderer.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <cstring>

namespace froxel::test {

namespace {

PFN_vkGetQueryPoolResults told_results = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL tellZeros(VkDevice device,
                                         VkQueryPool pool,
                                         uint32_t first,
                                         uint32_t count,
                                         size_t bytes,
                                         void* results,
                                         VkDeviceSize stride,
                                         VkQueryResultFlags flags) {
    const VkResult result = told_results(device, pool, first, count, bytes, results, stride, flags);
    std::memset(results, 0, bytes);
    return result;
}

// From now on as by a driver that writes no timestamps.
void writeNoTimestamps(const gpu::Device& device) {
    auto& driver = driverOf(device);
    told_results = driver.vkGetQueryPoolResults;
    driver.vkGetQueryPoolResults = tellZeros;
}

class Times : public GpuTest {};

render::FrameInputs inputsFor(const scene::Scene& scene, const settings::Size& size) {
    render::FrameInputs inputs;
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.size = size;
    return inputs;
}

TEST_F(Times, WrittenByNoDriver_AreUnknown_AndPicturesTheSame) {
    const scene::Scene scene = makeRoom();
    render::Renderer renderer(device(), scene);
    const auto inputs = inputsFor(scene, {64, 36});
    const Picture before = draw(renderer, inputs);
    writeNoTimestamps(device());
    const Picture after = draw(renderer, inputs);
    EXPECT_EQ(differingFloats(before, after), 0U);
    EXPECT_EQ(before.rgba8, after.rgba8);
    EXPECT_EQ(after.stats.gpu_us, std::nullopt);
    EXPECT_GT(after.stats.frame_us, 0);
    EXPECT_FALSE(after.stats.passes.empty());
    for (const PassTime& pass : after.stats.passes) {
        EXPECT_EQ(pass.gpu_us, std::nullopt) << pass.name;
    }
}

// 1 would be told where nothing was measured.
TEST_F(Times, WrittenByNoDriver_SpeedIsMeasured) {
    const scene::Scene scene = makeRoom();
    render::Renderer renderer(device(), scene);
    writeNoTimestamps(device());
    const auto speed =
        render::measureSpeed(renderer, device().traits().is_cpu, scene.cameras[0].camera);
    ASSERT_TRUE(speed);
    EXPECT_GT(speed->lights, 0);
    EXPECT_NE(speed->lights, 1);
    EXPECT_GT(speed->surfaces, 0);
    EXPECT_NE(speed->surfaces, 1);
}

// llvmpipe of Mesa 25 would take a dispatch's begin after its end, and tell next to nothing.
TEST_F(Times, LightingInCompute_HasTheTimeOfItsLights) {
    const scene::Scene scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(scene, {160, 90});
    inputs.settings.lights.count = 2000;
    inputs.settings.lights.radius_m = 1000;
    inputs.settings.light_loop = settings::LightLoop::kAllLights; // most of the frame
    render::ViewRenderer view(renderer);
    (void)drawPixels(view, inputs); // compiles
    // What else the device does meanwhile counts for the whole frame: one that has it alone tells.
    constexpr int kMostFrames = 50;
    double share = 0;
    for (int i = 0; i < kMostFrames && share <= 0.2; ++i) {
        const FrameStats stats = drawPixels(view, inputs).stats;
        const auto lighting = std::ranges::find(stats.passes, "lighting", &PassTime::name);
        ASSERT_NE(lighting, stats.passes.end());
        ASSERT_TRUE(lighting->gpu_us && stats.gpu_us);
        share = std::max(share, *lighting->gpu_us / *stats.gpu_us);
    }
    EXPECT_GT(share, 0.2);
}

} // namespace
} // namespace froxel::test
