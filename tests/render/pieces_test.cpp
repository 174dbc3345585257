// Frames that are cut, so that the device can be taken back between their pieces, are the same
// pictures to the bit.
#include "builtin_scene/hall.h"
#include "render/device/unit_costs.h"
#include "render/scene/scene_resources.h"
#include "render/view/renderer.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/step_frames.h"
#include "support/test_scenes.h"

#include <functional>
#include <string>

namespace froxel::test {

namespace {

using settings::Renderer;
using Change = std::function<void(render::FrameInputs&)>;

class Pieces : public SharedGpuTest {
  protected:
    static void TearDownTestSuite() {
        renderer_.reset();
        SharedGpuTest::TearDownTestSuite();
    }
    // Of all tests, as its pipelines are.
    [[nodiscard]] static render::Renderer& renderer() {
        if (!renderer_) {
            renderer_ = std::make_unique<render::Renderer>(device(), hall());
        }
        return *renderer_;
    }
    static const scene::Scene& hall() {
        static const scene::Scene scene = builtin_scene::makeHall();
        return scene;
    }
    // Small enough for tens of pieces.
    [[nodiscard]] static render::WorkLimits cut() {
        return {Seconds(100), onGpu() ? Seconds(4e-6) : Seconds(1e-3)};
    }
    [[nodiscard]] static render::FrameInputs inputs(size_t camera = 0) {
        render::FrameInputs inputs;
        inputs.settings.camera = hall().cameras.at(camera).camera;
        inputs.settings.size = {212, 119};
        inputs.settings.lights.count = 300;
        inputs.time_s = 2.5;
        return inputs;
    }
    // Draws whole and in pieces; both as pixels, and as radiance where there is some.
    static void expectSame(const render::FrameInputs& inputs, bool radiance = true) {
        render::ViewRenderer whole_view(renderer());
        render::ViewRenderer cut_view(renderer(), {}, cut());
        const auto drawn = [&](render::ViewRenderer& view) {
            return radiance ? draw(view, inputs) : drawPixels(view, inputs);
        };
        const Picture whole = drawn(whole_view);
        const Picture parts = drawn(cut_view);
        EXPECT_EQ(whole.rgba8, parts.rgba8);
        EXPECT_EQ(differingFloats(whole, parts), 0U);
        EXPECT_EQ(whole.stats.steps.count("peel", "overflow_pixels"),
                  parts.stats.steps.count("peel", "overflow_pixels"));
        EXPECT_EQ(whole.stats.steps.find("", "metered_ev"),
                  parts.stats.steps.find("", "metered_ev"));
        EXPECT_EQ(whole.stats.steps.count("pairs", "evaluated"),
                  parts.stats.steps.count("pairs", "evaluated"));
        EXPECT_EQ(whole.stats.steps.count("pairs", "contributing"),
                  parts.stats.steps.count("pairs", "contributing"));
        const auto work = cut_view.begin(inputs);
        ASSERT_TRUE(work) << work.error().message;
        EXPECT_GT(work->piece_count, 3U);
        cut_view.abandon();
    }

    // stages: calls that did not begin the frame.
    [[nodiscard]] static Picture
    drawInStages(render::ViewRenderer& view, const render::FrameInputs& inputs, int& stages) {
        auto work = view.begin(inputs);
        for (; work && work->half_built; ++stages) {
            work = view.begin(inputs);
        }
        for (uint32_t i = 0; work && i < work->piece_count; ++i) {
            EXPECT_TRUE(view.submitPiece());
        }
        auto frame = view.collect();
        if (!frame) {
            ADD_FAILURE() << frame.error().message;
            return {};
        }
        const PixelView& pixels = frame->pixels.view();
        return {.width_px = pixels.width_px,
                .height_px = pixels.height_px,
                .rgba8 = {pixels.data, pixels.data + pixels.stride_bytes * pixels.height_px},
                .radiance = {},
                .stats = frame->stats};
    }

  private:
    inline static std::unique_ptr<render::Renderer> renderer_;
};

} // namespace

TEST_F(Pieces, Renderers_DrawTheSameBits) {
    for (const Renderer renderer :
         {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kClusteredDeferred,
          Renderer::kToonFragment, Renderer::kToonCompute}) {
        for (const auto stage :
             {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
            SCOPED_TRACE(std::string(settings::kRendererNames[static_cast<size_t>(renderer)]) +
                         ", " + std::to_string(static_cast<int>(stage)));
            auto asked = inputs();
            asked.settings.renderer = renderer;
            asked.settings.lighting = stage;
            expectSame(asked);
        }
    }
}

TEST_F(Pieces, HostsPartInStages_DrawsTheSameBits) {
    const std::pair<const char*, Change> cases[] = {
        {"lists", [](auto& in) { in.settings.light_loop = settings::LightLoop::kLists; }},
        {"all lights", [](auto& in) { in.settings.light_loop = settings::LightLoop::kAllLights; }},
        {"capped lists", [](auto& in) { in.settings.list_cap = 4; }},
        {"halves",
         [](auto& in) {
             in.settings.renderer = Renderer::kClusteredDeferred;
             in.settings.gbuffer.position = settings::PositionSource::kFp16;
         }},
        {"wires", [](auto& in) { in.settings.debug.view = settings::DebugView::kClusterWires; }},
    };
    for (const auto& [name, change] : cases) {
        SCOPED_TRACE(name);
        auto asked = inputs();
        change(asked);
        render::ViewRenderer at_once(renderer());
        render::ViewRenderer view(renderer(), {}, {.host = Seconds(0)});
        const Picture whole = drawPixels(at_once, asked);
        int stages = 0;
        const Picture staged = drawInStages(view, asked, stages);
        EXPECT_EQ(whole.rgba8, staged.rgba8);
        // The device's own lists are one of its passes.
        const bool in_parts =
            !onGpu() && asked.settings.light_loop != settings::LightLoop::kAllLights;
        EXPECT_GE(stages, in_parts ? 4 : 3);
        EXPECT_GT(staged.stats.host_us, 0);
    }
}

TEST_F(Pieces, HalfBuilt_OtherInputs_AreBuiltAnew) {
    auto asked = inputs();
    render::ViewRenderer view(renderer(), {}, {.host = Seconds(0)});
    ASSERT_TRUE(view.begin(asked)->half_built);
    ASSERT_TRUE(view.begin(asked)->half_built);
    for (const Change& change : {Change([](auto& in) { in.time_s = 3; }), Change([](auto& in) {
                                     in.settings.camera = hall().cameras.at(1).camera;
                                 }),
                                 Change([](auto& in) { in.settings.lights.count = 100; }),
                                 Change([](auto& in) { in.settings.lights.count = 310; })}) {
        change(asked);
        ASSERT_TRUE(view.begin(asked)->half_built);
    }
    int stages = 0;
    render::ViewRenderer at_once(renderer());
    EXPECT_EQ(drawInStages(view, asked, stages).rgba8, drawPixels(at_once, asked).rgba8);
}

// The first one's lists are under way when the second comes to make its own.
TEST_F(Pieces, HalfBuiltOfTwoViews_DrawTheSameBits) {
    auto asked = inputs();
    asked.settings.light_loop = settings::LightLoop::kLists;
    auto later = asked;
    later.time_s = 3;
    render::ViewRenderer first(renderer(), {}, {.host = Seconds(0)});
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(first.begin(asked)->half_built);
    }
    render::ViewRenderer second(renderer(), {}, {.host = Seconds(0)});
    int stages = 0;
    const Picture of_second = drawInStages(second, later, stages);
    const Picture of_first = drawInStages(first, asked, stages);
    render::ViewRenderer at_once(renderer());
    EXPECT_EQ(of_first.rgba8, drawPixels(at_once, asked).rgba8);
    EXPECT_EQ(of_second.rgba8, drawPixels(at_once, later).rgba8);
}

TEST_F(Pieces, ListsOfAnyGrid_DrawTheSameBits) {
    for (const settings::GridSize grid :
         {settings::GridSize{1, 1, 64}, {16, 9, 24}, {128, 128, 2}}) {
        auto asked = inputs();
        asked.settings.grid = {.automatic = false, .size = grid};
        asked.settings.light_loop = settings::LightLoop::kLists;
        expectSame(asked);
    }
}

TEST_F(Pieces, FramesOfEveryStep_DrawTheSameBits) {
    for (const auto& [name, change] : stepFrames()) {
        SCOPED_TRACE(name);
        auto asked = inputs();
        change(asked);
        const bool radiance = !settings::replacesPicture(asked.settings.debug.view);
        asked.outputs = {}; // expectSame() asks for it
        expectSame(asked, radiance);
    }
}

// A software device compiles a pipeline as it draws with it for the first time, whole: what follows
// does not go into the same piece.
TEST_F(Pieces, FirstUseOfAnEffectsPipeline_EndsItsPiece_OnASoftwareDevice) {
    if (onGpu()) {
        GTEST_SKIP() << "a GPU's pipelines are compiled before they are recorded";
    }
    render::Renderer fresh(device(), hall());
    render::ViewRenderer view(fresh, {}, {Seconds(100), Seconds(100)});
    (void)drawPixels(view, inputs());
    auto metered = inputs();
    metered.settings.exposure_mode = settings::ExposureMode::kFrame;
    std::vector<uint32_t> pieces;
    for (int frame = 0; frame < 2; ++frame) {
        const auto work = view.begin(metered);
        ASSERT_TRUE(work) << work.error().message;
        pieces.push_back(work->piece_count);
        for (uint32_t i = 0; i < work->piece_count; ++i) {
            ASSERT_TRUE(view.submitPiece());
        }
        ASSERT_TRUE(view.collect());
    }
    EXPECT_GT(pieces[0], 1U);
    EXPECT_EQ(pieces[1], 1U);
}

TEST_F(Pieces, BlendedSurfaces_DrawTheSameBits) {
    const auto& cameras = hall().cameras;
    size_t glass = 0;
    while (cameras.at(glass).name != "Glass") {
        ++glass;
    }
    for (const auto kind : {settings::Transparency::kSorted, settings::Transparency::kWeighted,
                            settings::Transparency::kPeeled}) {
        auto asked = inputs(glass);
        asked.settings.transparency = kind;
        asked.settings.peel_layers = 3;
        expectSame(asked);
    }
}

TEST_F(Pieces, DebugViews_DrawTheSameBits) {
    for (const auto view : {settings::DebugView::kDepth, settings::DebugView::kEvaluatedLights,
                            settings::DebugView::kOverdraw, settings::DebugView::kInstances,
                            settings::DebugView::kGbuffer, settings::DebugView::kClusterWires,
                            settings::DebugView::kLightSpheres}) {
        auto asked = inputs();
        asked.settings.debug.view = view;
        expectSame(asked, false);
    }
}

TEST_F(Pieces, OfTwoViewsInTurn_DrawTheSameBits) {
    render::ViewRenderer alone(renderer());
    auto first = inputs(0);
    auto second = inputs(1);
    second.settings.renderer = Renderer::kForwardPlus;
    second.settings.lighting = settings::LightingStage::kCompute; // views share what culling writes
    const Picture first_whole = drawPixels(alone, first);
    const Picture second_whole = drawPixels(alone, second);

    render::ViewRenderer a(renderer(), {}, cut());
    render::ViewRenderer b(renderer(), {}, cut());
    ASSERT_TRUE(a.begin(first));
    ASSERT_TRUE(b.begin(second));
    std::optional<render::RenderedFrame> frame_a;
    std::optional<render::RenderedFrame> frame_b;
    const auto step = [](render::ViewRenderer& view, std::optional<render::RenderedFrame>& frame,
                         const render::FrameInputs& asked) {
        if (!frame) {
            ASSERT_TRUE(view.submitPiece());
            auto done = view.collectPiece();
            ASSERT_TRUE(done);
            if (done->again) { // lists from the device, which are known from then on
                ASSERT_TRUE(view.begin(asked));
            }
            frame = std::move(done->frame);
        }
    };
    while (!frame_a || !frame_b) {
        ASSERT_NO_FATAL_FAILURE(step(a, frame_a, first));
        ASSERT_NO_FATAL_FAILURE(step(b, frame_b, second));
    }
    const auto pixels = [](const render::RenderedFrame& frame) {
        const auto& view = frame.pixels.view();
        return std::vector<std::byte>(view.data,
                                      view.data + size_t{4} * view.width_px * view.height_px);
    };
    EXPECT_EQ(pixels(*frame_a), first_whole.rgba8);
    EXPECT_EQ(pixels(*frame_b), second_whole.rgba8);
}

TEST_F(Pieces, GivenUp_LeaveTheViewAsItWas) {
    render::ViewRenderer view(renderer(), {}, cut());
    const Picture before = drawPixels(view, inputs());
    auto other = inputs(1);
    ASSERT_TRUE(view.begin(other));
    ASSERT_TRUE(view.submitPiece());
    EXPECT_FALSE(view.canSubmit());
    view.abandon();
    const auto piece = view.collectPiece();
    ASSERT_TRUE(piece);
    EXPECT_FALSE(piece->frame || piece->again);
    EXPECT_TRUE(view.canSubmit());
    EXPECT_EQ(view.inFlight(), 0U);
    EXPECT_EQ(drawPixels(view, inputs()).rgba8, before.rgba8);
}

TEST_F(Pieces, FramesOverTheLimit_AreRefusedBeforeAnythingIsAllocated) {
    render::ViewRenderer view(renderer(), {}, {Seconds(1), Seconds(0.25)});
    auto asked = inputs();
    asked.settings.renderer = Renderer::kNaive;
    asked.settings.lights.count = 1'000'000;
    asked.settings.size = {4096, 4096};
    const auto begun = view.begin(asked);
    ASSERT_FALSE(begun);
    EXPECT_EQ(begun.error().code, ErrorCode::kTooLong);
    EXPECT_THAT(begun.error().message, ::testing::HasSubstr("all 1000000 lights"));
    EXPECT_THAT(begun.error().message, ::testing::HasSubstr("a frame may take 1 s"));
    EXPECT_FALSE(drawPixels(view, inputs()).rgba8.empty());
}

// A frame whose lists the device makes is cut only when these are known to be long.
TEST_F(Pieces, ListsFromTheDevice_AreDrawnAgainInPieces_ToTheSameBits) {
    auto asked = inputs();
    asked.settings.light_loop = settings::LightLoop::kLists;
    asked.assignment = render::AssignmentPlace::kDevice;
    asked.settings.lights.radius_m = 30;
    render::ViewRenderer whole(renderer());
    const Picture before = drawPixels(whole, asked);
    EXPECT_EQ(before.stats.lists.redraw_count, 0U);

    render::ViewRenderer view(renderer(), {}, cut());
    uint32_t again_count = 0;
    uint32_t pieces = 0;
    std::optional<render::RenderedFrame> frame;
    while (!frame && again_count < 5) {
        const auto work = view.begin(asked);
        ASSERT_TRUE(work);
        pieces = work->piece_count;
        for (uint32_t i = 0; i < pieces; ++i) {
            ASSERT_TRUE(view.submitPiece());
            auto done = view.collectPiece();
            ASSERT_TRUE(done);
            again_count += done->again ? 1U : 0U;
            frame = std::move(done->frame);
        }
    }
    ASSERT_TRUE(frame);
    EXPECT_GE(again_count, 1U);
    EXPECT_GT(pieces, 3U);
    const auto& pixels = frame->pixels.view();
    EXPECT_EQ(std::vector<std::byte>(pixels.data,
                                     pixels.data + size_t{4} * pixels.width_px * pixels.height_px),
              before.rgba8);
}

// One huge light and a million tiny ones in a grid of one tile: the 95th percentile of its lists is
// 1, and the floor's pixels loop over nearly all.
TEST_F(Pieces, ListsThatHoldNearlyAllLights_CountAsWhatTheyHold) {
    for (const auto place : {render::AssignmentPlace::kHost, render::AssignmentPlace::kDevice}) {
        render::ViewRenderer view(renderer(), {}, {Seconds(1), Seconds(onGpu() ? 0.05 : 0.25)});
        auto asked = inputs();
        asked.assignment = place;
        asked.settings.lights.count = 1'000'000;
        asked.settings.lights.radius_m = 0.05F;
        asked.settings.grid = {.automatic = false, .size = {1, 1, 256}};
        asked.settings.light_loop = settings::LightLoop::kLists;
        asked.settings.lighting = settings::LightingStage::kFragment;
        asked.settings.size = {1280, 720};
        auto begun = view.begin(asked);
        for (int again = 0; begun && again < 3; ++again) { // lists that outgrow their buffers first
            for (uint32_t i = 0; i < begun->piece_count; ++i) {
                ASSERT_TRUE(view.submitPiece());
                const auto piece = view.collectPiece();
                ASSERT_TRUE(piece);
                ASSERT_FALSE(piece->frame) << "the frame was drawn";
            }
            begun = view.begin(asked);
        }
        ASSERT_FALSE(begun) << begun->estimate.count() << " s";
        EXPECT_EQ(begun.error().code, ErrorCode::kTooLong);
    }
}

// A device of a fast pace, of whose pieces a view has a small share: each part has a timestamp.
TEST_F(Pieces, HoweverFine_HaveTheirTimestamps) {
    render::ViewRenderer view(renderer(), {}, {Seconds(100), Seconds(1e-9)});
    view.setPace({.pace = 1.0 / 32, .frame_share = 1});
    auto asked = inputs();
    asked.settings.size = {1280, 720};
    const auto begun = view.begin(asked);
    ASSERT_TRUE(begun);
    EXPECT_GT(begun->piece_count, 10U);
    EXPECT_LT(begun->piece_count, 4096U);
}

// By a GPU's prices: there a loop over many lights takes long, however few pixels go through it.
// Lists that the device makes are known after a first look; what one loop may take bounds them.
TEST_F(Pieces, ListsLongerThanALoopMayBe_AreRefused_OthersDrawnAgainAndAgain) {
    render::Renderer priced(device(), hall());
    priced.resources().shared.unit_costs = render::kGpuUnitCosts;
    auto asked = inputs();
    asked.settings.light_loop = settings::LightLoop::kLists;
    asked.assignment = render::AssignmentPlace::kDevice;
    asked.settings.lighting = settings::LightingStage::kFragment;
    asked.settings.lights.radius_m = 5;
    render::ViewRenderer whole(priced);
    const Picture before = drawPixels(whole, asked);
    const double longest = before.stats.lists.largest * render::kGpuUnitCosts.fragment.loop;
    ASSERT_LT(before.stats.lists.largest, asked.settings.lights.count);

    for (const double share : {1.02, 0.9}) {
        render::ViewRenderer view(
            priced, {},
            {.frame = Seconds(100), .piece = Seconds(4e-6), .loop = Seconds(share * longest)});
        int drawn = 0;
        int again = 0;
        bool refused = false;
        for (int frame = 0; frame < 6 && !refused; ++frame) {
            const auto work = view.begin(asked);
            refused = !work;
            for (uint32_t i = 0; work && i < work->piece_count; ++i) {
                ASSERT_TRUE(view.submitPiece());
                const auto piece = view.collectPiece();
                ASSERT_TRUE(piece);
                again += piece->again ? 1 : 0;
                drawn += piece->frame ? 1 : 0;
            }
        }
        EXPECT_EQ(refused, share < 1) << share;
        EXPECT_EQ(drawn, share < 1 ? 0 : 6 - again) << share;
        EXPECT_LE(again, 2) << share;
    }
}

} // namespace froxel::test
