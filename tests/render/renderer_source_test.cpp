#include "stream/renderer_source.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace froxel::test {
namespace {

using ::testing::HasSubstr;

// What is logged while it lives.
class LogText {
  public:
    LogText() {
        spdlog::set_default_logger(std::make_shared<spdlog::logger>(
            "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_)));
    }
    ~LogText() { spdlog::set_default_logger(before_); }
    LogText(const LogText&) = delete;
    LogText& operator=(const LogText&) = delete;
    [[nodiscard]] std::string text() const { return text_.str(); }

  private:
    const std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
    std::ostringstream text_;
};

template <VkResult result>
VKAPI_ATTR VkResult VKAPI_CALL failToCreate(VkDevice /*device*/,
                                            const VkDescriptorPoolCreateInfo* /*info*/,
                                            const VkAllocationCallbacks* /*allocator*/,
                                            VkDescriptorPool* /*pool*/) {
    return result;
}
constexpr PFN_vkCreateDescriptorPool kNoDeviceMemory = failToCreate<VK_ERROR_OUT_OF_DEVICE_MEMORY>;
constexpr PFN_vkCreateDescriptorPool kNoHostMemory = failToCreate<VK_ERROR_OUT_OF_HOST_MEMORY>;

// The functions that the device's driver has; tests replace some.
vk::raii::DeviceDispatcher& driverOf(const gpu::Device& device) {
    return const_cast<vk::raii::DeviceDispatcher&>(*device.handle().getDispatcher());
}

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
// From now on as one that writes no timestamps.
void writeNoTimestamps(const gpu::Device& device) {
    told_results = driverOf(device).vkGetQueryPoolResults;
    driverOf(device).vkGetQueryPoolResults = tellZeros;
}

// By a view of all of it: the default speed, 1, would be told where nothing was seen.
TEST(RendererSource, SceneWithoutCameras_SpeedIsMeasured) {
    scene::Scene scene = makeRoom();
    scene.cameras.clear();
    const LogText log;
    const auto source = stream::makeRendererSource(openTestDevice(), scene, Seconds(10), {});
    EXPECT_THAT(log.text(), HasSubstr("event=device_speed lights="));
    EXPECT_EQ(log.text().find("lights=1.00 surfaces=1.00"), std::string::npos) << log.text();
}

TEST(RendererSource, DriverThatWritesNoTimestamps_SpeedIsMeasured) {
    auto device = openTestDevice();
    writeNoTimestamps(*device);
    const LogText log;
    const auto source = stream::makeRendererSource(std::move(device), makeRoom(), Seconds(10), {});
    EXPECT_THAT(log.text(), HasSubstr("event=device_speed lights="));
    EXPECT_EQ(log.text().find("lights=1.00 surfaces=1.00"), std::string::npos) << log.text();
}

TEST(Renderer, DriverThatWritesNoTimestamps_TimesAreUnknownAndPicturesTheSame) {
    const auto device = openTestDevice();
    const scene::Scene scene = makeRoom();
    render::Renderer renderer(*device, scene);
    render::FrameInputs inputs;
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.size = {64, 36};
    const Picture before = draw(renderer, inputs);
    writeNoTimestamps(*device);
    const Picture after = draw(renderer, inputs);
    EXPECT_EQ(differingFloats(before, after), 0U);
    EXPECT_EQ(before.rgba8, after.rgba8);
    EXPECT_EQ(after.stats.gpu_us, std::nullopt);
    EXPECT_GT(after.stats.frame_us, 0);
    EXPECT_FALSE(after.stats.passes.empty());
    for (const PassTime& pass : after.stats.passes) {
        EXPECT_EQ(pass.gpu_us, std::nullopt) << pass.name;
    }
    EXPECT_THAT(device->validationLog().messages(), ::testing::IsEmpty());
}

// Lighting that takes most of the frame, in compute: lavapipe would begin to count when it is done.
TEST(Renderer, TimeOfCompute_IsItsPasses) {
    const auto device = openTestDevice();
    const scene::Scene scene = makeRoom();
    render::Renderer renderer(*device, scene);
    render::FrameInputs inputs;
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.size = {160, 90};
    inputs.settings.lights.count = 2000;
    inputs.settings.lights.radius_m = 1000;
    inputs.settings.light_loop = view::LightLoop::kAllLights;
    render::ViewRenderer view(renderer);
    (void)drawPixels(view, inputs); // compiles
    const FrameStats stats = drawPixels(view, inputs).stats;
    const auto lighting = std::ranges::find(stats.passes, "lighting", &PassTime::name);
    ASSERT_NE(lighting, stats.passes.end());
    ASSERT_TRUE(lighting->gpu_us && stats.gpu_us);
    EXPECT_GT(*lighting->gpu_us, 0.5 * *stats.gpu_us);
    EXPECT_THAT(device->validationLog().messages(), ::testing::IsEmpty());
}

TEST(RendererSource, NoMemoryForAView_IsRefusedAndTheNextOneMayFit) {
    auto device = openTestDevice();
    auto& driver = driverOf(*device); // one of its functions now finds no memory
    const auto source = stream::makeRendererSource(std::move(device), makeRoom(), Seconds(10), {});
    const auto create_pool = driver.vkCreateDescriptorPool;
    for (const auto fail : {kNoDeviceMemory, kNoHostMemory}) {
        driver.vkCreateDescriptorPool = fail;
        const auto view = source->makeView();
        ASSERT_FALSE(view);
        EXPECT_EQ(view.error().code, ErrorCode::kCapacity);
        EXPECT_THAT(view.error().message, HasSubstr("has no memory"));
    }
    driver.vkCreateDescriptorPool = create_pool;
    EXPECT_TRUE(source->makeView());
}

} // namespace
} // namespace froxel::test
