#include "froxel/v1/server.pb.h"
#include "render/steps/order.h"
#include "scene/enclosing_sphere.h"
#include "session/state_message.h"
#include "stream/renderer_source.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

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

settings::Camera wholeOf(const scene::Scene& scene) {
    return settings::overview(scene::enclosingSphere(scene), 1);
}

template <VkResult result>
VKAPI_ATTR VkResult VKAPI_CALL failToCreate(VkDevice /*device*/,
                                            const VkDescriptorPoolCreateInfo* /*info*/,
                                            const VkAllocationCallbacks* /*allocator*/,
                                            VkDescriptorPool* /*pool*/) {
    return result;
}
constexpr PFN_vkCreateDescriptorPool kNoDeviceMemory = failToCreate<VK_ERROR_OUT_OF_DEVICE_MEMORY>;
constexpr PFN_vkCreateDescriptorPool kNoHostMemory = failToCreate<VK_ERROR_OUT_OF_HOST_MEMORY>;

// By a view of all of it: the default speed, 1, would be told where nothing was seen.
TEST(RendererSource, SceneWithoutCameras_SpeedIsMeasured) {
    scene::Scene scene = makeRoom();
    scene.cameras.clear();
    const LogText log;
    const auto source =
        stream::makeRendererSource(openTestDevice(), scene, wholeOf(scene), Seconds(10), {});
    EXPECT_THAT(log.text(), HasSubstr("event=device_speed lights="));
    EXPECT_EQ(log.text().find("lights=1.00 surfaces=1.00"), std::string::npos) << log.text();
}

TEST(RendererSource, NoMemoryForAView_IsRefusedAndTheNextOneMayFit) {
    auto device = openTestDevice();
    const scene::Scene room = makeRoom();
    // The driver's functions, of which one now finds no memory.
    auto& driver = driverOf(*device);
    const auto source =
        stream::makeRendererSource(std::move(device), room, wholeOf(room), Seconds(10), {});
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

// Pixels, or the file that the device made of them, as the frame's terms allow.
TEST(RendererSource, PlaceOfJpegs_IsAsChosen) {
    const scene::Scene room = makeRoom();
    for (const auto place :
         {stream::JpegPlace::kAuto, stream::JpegPlace::kHost, stream::JpegPlace::kDevice}) {
        const LogText log;
        const auto source = stream::makeRendererSource(openTestDevice(), room, wholeOf(room),
                                                       Seconds(10), {}, {}, {place, 1});
        const bool compared = onGpu() && place == stream::JpegPlace::kAuto;
        const bool on_device = place == stream::JpegPlace::kDevice;
        EXPECT_EQ(log.text().find("event=jpeg_encoder") != std::string::npos,
                  on_device || compared);
        const auto view = source->makeView();
        ASSERT_TRUE(view);
        for (const auto codec :
             {settings::Codec::kJpeg, settings::Codec::kVp9, settings::Codec::kPng}) {
            settings::ViewSettings settings;
            settings.size = {64, 48};
            const auto work = (*view)->begin(
                settings, {}, {.encoding = {.becomes = settings::Encoding{.codec = codec}}});
            ASSERT_TRUE(work) << work.error().message;
            for (uint32_t i = 0; i < work->piece_count; ++i) {
                ASSERT_TRUE((*view)->submitPiece());
                const auto collected = (*view)->collect();
                ASSERT_TRUE(collected);
                if (!compared && collected->frame) {
                    const PixelView& pixels = collected->frame->pixels.view();
                    EXPECT_EQ(!pixels.jpeg.empty(), on_device && codec == settings::Codec::kJpeg);
                    EXPECT_EQ(pixels.planes.has_value(),
                              on_device && codec == settings::Codec::kVp9);
                    EXPECT_EQ(pixels.data == nullptr, on_device && codec != settings::Codec::kPng);
                }
            }
        }
    }
}

// What steps tell of themselves is in the schema, under the names that their rows have.
TEST(StepRows, Figures_HaveFieldsOfTheHeader) {
    session::FrameRecord record;
    uint32_t count = 0;
    for (const render::StepRow* step : render::kOrder) {
        for (const StatRow& row : step->stats) {
            record.stats.steps.set(row, 1);
            count += row.field.empty() ? 0U : 1U;
        }
    }
    const v1::FrameHeader header = session::makeFrameHeader(record);
    EXPECT_TRUE(header.has_pairs() && header.has_peel() && header.has_shadows() &&
                header.has_metered_ev());
    EXPECT_EQ(count, 9U);
}

} // namespace
} // namespace froxel::test
