// Copies to the host beside frames, against those in the frames' own commands. lavapipe has one
// queue, which then stands for both, and copies planes alone.
#include "render/scene/scene_resources.h"
#include "render/view/renderer.h"
#include "support/gpu_fixture.h"
#include "support/planes.h"
#include "support/test_scenes.h"

namespace froxel::test {
namespace {

using Bytes = std::vector<std::byte>;

class HostCopies : public GpuTest {
  protected:
    void SetUp() override {
        inputs_.settings.camera = settings::lookAt({2.5, 1.6, 3.5}, {0, 0.8, -1}, {0, 1, 0});
        inputs_.settings.size = {150, 70};
        inputs_.settings.lights.count = 20;
    }
    // Nothing of the last device may be left but the renderer.
    void open(gpu::CopyQueue queue) {
        renderer_.reset();
        gpu::DeviceOptions options;
        options.copy_queue = queue;
        openDevice(options);
        renderer_ = std::make_unique<render::Renderer>(device(), makeRoom());
    }
    void TearDown() override {
        renderer_.reset();
        GpuTest::TearDown();
    }
    // Its own queue where there is one.
    void openBeside() {
        open(gpu::CopyQueue::kOwn);
        if (!renderer_->resources().shared.copies) {
            open(gpu::CopyQueue::kSame);
        }
        ASSERT_TRUE(renderer_->resources().shared.copies);
    }
    // A frame of these lights.
    void submit(render::ViewRenderer& view, uint32_t seed) {
        inputs_.settings.lights.seed = seed;
        const auto submitted = view.submit(inputs_);
        ASSERT_TRUE(submitted) << submitted.error().message;
    }
    static Bytes collect(render::ViewRenderer& view) {
        const auto frame = view.collect();
        EXPECT_TRUE(frame) << frame.error().message;
        const PixelView& pixels = frame->pixels.view();
        if (!pixels.planes) {
            return {pixels.data, pixels.data + pixels.stride_bytes * pixels.height_px};
        }
        const std::byte* luma = pixels.planes->data[0]; // and behind it the rest
        const std::byte* last = pixels.planes->data[2];
        return {luma, last + pixels.planes->stride_bytes[2] * ((pixels.height_px + 1) / 2)};
    }
    Bytes drawAlone(uint32_t seed) {
        render::ViewRenderer view(*renderer_);
        submit(view, seed);
        return collect(view);
    }
    // Frames of two views, two of one in flight, of several sizes.
    std::vector<Bytes> draw() {
        render::ViewRenderer one(*renderer_);
        render::ViewRenderer other(*renderer_);
        std::vector<Bytes> made;
        uint32_t seed = 0;
        for (const settings::Size size : {settings::Size{150, 70}, {64, 48}, {320, 200}}) {
            inputs_.settings.size = size;
            for (int i = 0; i < 4; ++i) {
                submit(one, ++seed);
                submit(other, ++seed);
                submit(one, ++seed);
                made.push_back(collect(one));
                made.push_back(collect(other));
                made.push_back(collect(one));
            }
        }
        return made;
    }
    void expectSame() {
        open(gpu::CopyQueue::kNone);
        ASSERT_FALSE(renderer_->resources().shared.copies);
        const auto expected = draw();
        EXPECT_NE(expected[0], expected[1]);
        openBeside();
        EXPECT_TRUE(draw() == expected);
    }

    std::unique_ptr<render::Renderer> renderer_;
    render::FrameInputs inputs_;
};

TEST_F(HostCopies, PixelsBesideFrames_AreThoseWithinThem) {
    expectSame();
}

TEST_F(HostCopies, PlanesBesideFrames_AreThoseWithinThem) {
    inputs_.form.plane_sampling = 2;
    expectSame();
}

TEST_F(HostCopies, AfterAFrameThatWasGivenUp_AreOfTheNextOne) {
    inputs_.form.plane_sampling = 2;
    open(gpu::CopyQueue::kNone);
    const Bytes expected = drawAlone(2);
    openBeside();
    render::WorkLimits fine;
    fine.piece = Seconds(1e-4);
    render::ViewRenderer view(*renderer_, render::ListLimits(), fine);
    submit(view, 1);
    (void)collect(view);
    inputs_.settings.lights.seed = 3;
    const auto work = view.begin(inputs_);
    ASSERT_TRUE(work) << work.error().message;
    ASSERT_GT(work->piece_count, 1U);
    ASSERT_TRUE(view.submitPiece());
    view.abandon();
    ASSERT_TRUE(view.collectPiece());
    submit(view, 2);
    EXPECT_TRUE(collect(view) == expected);
}

} // namespace
} // namespace froxel::test
