// Frames that come to the host as JPEGs or planes: what TurboJPEG makes of their pixels.
#include "encode/jpeg_encoder.h"
#include "encode/jpeg_format.h"
#include "render/view/renderer.h"
#include "support/gpu_fixture.h"
#include "support/planes.h"
#include "support/step_frames.h"
#include "support/test_scenes.h"

#include <algorithm>

namespace froxel::test {
namespace {

using settings::Chroma;
using settings::Encoding;

class JpegFrame : public SharedGpuTest {
  protected:
    static void SetUpTestSuite() {
        SharedGpuTest::SetUpTestSuite();
        renderer_ = std::make_unique<render::Renderer>(device(), makeRoom());
    }
    static void TearDownTestSuite() {
        renderer_.reset();
        SharedGpuTest::TearDownTestSuite();
    }
    void SetUp() override {
        view_ = std::make_unique<render::ViewRenderer>(*renderer_);
        inputs_.settings.camera = settings::lookAt({2.5, 1.6, 3.5}, {0, 0.8, -1}, {0, 1, 0});
        inputs_.settings.size = {150, 70};
        inputs_.settings.lights.count = 20;
        inputs_.keep_surfaces = true;
    }

    [[nodiscard]] static std::shared_ptr<const JpegFormat> formatOf(const Encoding& encoding) {
        static encode::JpegFormats formats;
        return *formats.of(encoding);
    }
    [[nodiscard]] render::RenderedFrame draw(const render::FrameInputs& inputs) {
        const auto submitted = view_->submit(inputs);
        EXPECT_TRUE(submitted) << submitted.error().message;
        auto frame = view_->collect();
        EXPECT_TRUE(frame) << frame.error().message;
        return std::move(*frame);
    }
    // Draws both on the view, one after the other.
    void expectFile(render::FrameInputs inputs, const Encoding& encoding) {
        inputs.form = {};
        const auto plain = draw(inputs);
        ASSERT_NE(plain.pixels.view().data, nullptr);
        EXPECT_TRUE(plain.pixels.view().jpeg.empty());
        const auto expected = encode::JpegEncoder().encode(plain.pixels.view(), encoding);
        ASSERT_TRUE(expected) << expected.error().message;
        inputs.form = {.jpeg = formatOf(encoding)};
        const auto made = draw(inputs);
        EXPECT_EQ(made.pixels.view().data, nullptr);
        EXPECT_EQ(made.pixels.view().width_px, inputs.settings.size.width_px);
        EXPECT_EQ(made.pixels.view().height_px, inputs.settings.size.height_px);
        EXPECT_TRUE(std::ranges::equal(made.pixels.view().jpeg, *expected))
            << made.pixels.view().jpeg.size() << " bytes for " << expected->size();
    }

    // Likewise as planes.
    void expectPlanes(render::FrameInputs inputs, Chroma chroma) {
        inputs.form = {};
        const auto plain = draw(inputs);
        PlaneView expected;
        const auto kept = planesOf(plain.pixels.view(), chroma, 0, expected);
        inputs.form.plane_sampling = chroma == Chroma::k420 ? 2 : 1;
        const auto made = draw(inputs);
        const PixelView& view = made.pixels.view();
        ASSERT_TRUE(view.planes);
        EXPECT_EQ(view.data, nullptr);
        EXPECT_EQ(view.width_px, inputs.settings.size.width_px);
        for (size_t plane = 0; plane < kept.size(); ++plane) {
            const uint32_t sampling = plane == 0 ? 1 : inputs.form.plane_sampling;
            const size_t width = (view.width_px + sampling - 1) / sampling;
            for (size_t y = 0; y < (view.height_px + sampling - 1) / sampling; ++y) {
                const std::byte* row = expected.data[plane] + y * expected.stride_bytes[plane];
                EXPECT_TRUE(
                    std::equal(row, row + width,
                               view.planes->data[plane] + y * view.planes->stride_bytes[plane]))
                    << "row " << y << " of plane " << plane;
            }
        }
    }

    inline static std::unique_ptr<render::Renderer> renderer_;
    std::unique_ptr<render::ViewRenderer> view_;
    render::FrameInputs inputs_;
};

TEST_F(JpegFrame, OfEveryKind_IsTheFileOfItsPixels) {
    for (const StepFrame& frame : stepFrames()) {
        SCOPED_TRACE(frame.name);
        auto inputs = inputs_;
        frame.change(inputs);
        expectFile(inputs, {.quality = 85});
    }
}

TEST_F(JpegFrame, OfEveryKindAsPlanes_HasThoseOfItsPixels) {
    for (const StepFrame& frame : stepFrames()) {
        SCOPED_TRACE(frame.name);
        auto inputs = inputs_;
        frame.change(inputs);
        expectPlanes(inputs, Chroma::k420);
    }
}

TEST_F(JpegFrame, PlanesAfterOthersOfTheView_AreThoseOfItsPixels) {
    for (const Chroma chroma : {Chroma::k420, Chroma::k444, Chroma::k420}) {
        for (const settings::Size size :
             {settings::Size{150, 70}, {64, 48}, {33, 95}, {34, 17}, {35, 18}}) {
            SCOPED_TRACE(testing::Message() << size.width_px << "x" << size.height_px);
            inputs_.settings.size = size;
            expectPlanes(inputs_, chroma);
            expectFile(inputs_, {.quality = 85, .chroma = chroma});
        }
    }
}

TEST_F(JpegFrame, AfterOthersOfTheView_IsTheFileOfItsPixels) {
    for (const uint32_t quality : {85U, 97U, 20U}) {
        for (const Chroma chroma : {Chroma::k420, Chroma::k444}) {
            for (const settings::Size size : {settings::Size{150, 70}, {64, 48}, {33, 95}}) {
                inputs_.settings.size = size;
                expectFile(inputs_, {.quality = quality, .chroma = chroma});
            }
        }
    }
}

TEST_F(JpegFrame, SeveralInFlight_AreEachTheirOwn) {
    const Encoding encoding{.quality = 90};
    std::vector<std::vector<std::byte>> expected;
    for (uint32_t seed = 1; seed <= 3; ++seed) {
        inputs_.settings.lights.seed = seed;
        inputs_.form = {};
        const auto plain = draw(inputs_);
        expected.push_back(*encode::JpegEncoder().encode(plain.pixels.view(), encoding));
    }
    inputs_.form.jpeg = formatOf(encoding);
    for (uint32_t seed = 1; seed <= 2; ++seed) {
        inputs_.settings.lights.seed = seed;
        ASSERT_TRUE(view_->submit(inputs_));
    }
    for (size_t i = 0; i < 2; ++i) {
        const auto frame = view_->collect();
        ASSERT_TRUE(frame);
        EXPECT_TRUE(std::ranges::equal(frame->pixels.view().jpeg, expected[i])) << i;
    }
    EXPECT_NE(expected[0], expected[1]);
}

// Given up before its JPEG, and once more after that of another frame.
TEST_F(JpegFrame, AfterAFrameThatWasGivenUp_IsTheFileOfItsPixels) {
    render::WorkLimits fine;
    fine.piece = Seconds(1e-4);
    for (int i = 0; i < 2; ++i) {
        view_ = std::make_unique<render::ViewRenderer>(*renderer_, render::ListLimits(), fine);
        for (int k = 0; k <= i; ++k) {
            inputs_.form.jpeg = formatOf({.quality = 85});
            const auto work = view_->begin(inputs_);
            ASSERT_TRUE(work) << work.error().message;
            ASSERT_GT(work->piece_count, 1U);
            ASSERT_TRUE(view_->submitPiece());
            view_->abandon();
            ASSERT_TRUE(view_->collectPiece());
            expectFile(inputs_, {.quality = 85});
        }
    }
}

TEST_F(JpegFrame, Passes_AreTimed) {
    inputs_.form.jpeg = formatOf({.quality = 85});
    const auto frame = draw(inputs_);
    for (const char* name : {"jpeg_blocks", "jpeg_place", "jpeg_stuff"}) {
        EXPECT_TRUE(std::ranges::any_of(frame.stats.passes, [name](const PassTime& pass) {
            return pass.name == name;
        })) << name;
    }
    EXPECT_TRUE(std::ranges::none_of(frame.stats.passes,
                                     [](const PassTime& pass) { return pass.name == "readback"; }));
}

} // namespace
} // namespace froxel::test
