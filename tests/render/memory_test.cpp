// What memoryNeed() says against what the device's ledger has, and the budget that is asked with
// it.
#include "render/view/memory_need.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/step_frames.h"
#include "support/test_scenes.h"

#include <utility>
#include <vector>

namespace froxel::test {

namespace {

using render::FrameInputs;

FrameInputs small() {
    FrameInputs inputs;
    inputs.settings.size = {640, 360};
    inputs.settings.lights.count = 50;
    return inputs;
}

// Besides those of every step.
const std::vector<StepFrame> kFrames = {
    {"odd size",
     [](FrameInputs& f) {
         f.settings.size = {1333, 377};
     }},
    {"many lights", [](FrameInputs& f) { f.settings.lights.count = 2'000; }},
    {"wide gbuffer",
     [](FrameInputs& f) { f.settings.gbuffer.position = settings::PositionSource::kFp32; }},
};

} // namespace

class MemoryNeed : public SharedGpuTest {
  protected:
    static void SetUpTestSuite() {
        SharedGpuTest::SetUpTestSuite();
        scene_ = std::make_unique<scene::Scene>(makeRoom());
    }
    static void TearDownTestSuite() {
        scene_.reset();
        SharedGpuTest::TearDownTestSuite();
    }
    // As many frames as there are slots, all kept, so that every slot has its buffers.
    static void fill(render::ViewRenderer& view, const FrameInputs& inputs) {
        std::vector<render::RenderedFrame> kept;
        while (view.canSubmit()) {
            const auto submitted = view.submit(inputs);
            ASSERT_TRUE(submitted) << submitted.error().message;
            auto frame = view.collect();
            ASSERT_TRUE(frame) << frame.error().message;
            kept.push_back(std::move(*frame));
        }
    }
    [[nodiscard]] static uint64_t allocated() { return device().memoryLedger()->totalBytes(); }

    inline static std::unique_ptr<scene::Scene> scene_;
};

TEST_F(MemoryNeed, EveryKindOfFrame_TakesWhatWasSaidAndHardlyLess) {
    render::Renderer renderer(device(), *scene_);
    std::vector<StepFrame> frames(stepFrames().begin(), stepFrames().end());
    frames.insert(frames.end(), kFrames.begin(), kFrames.end());
    for (const auto& [name, change] : frames) {
        FrameInputs inputs = small();
        inputs.settings.camera = scene_->cameras.at(0).camera;
        change(inputs);
        {
            render::ViewRenderer warm(renderer); // what the scene makes at first use
            fill(warm, inputs);
        }
        const uint64_t shared = allocated();
        const uint64_t taken_before = renderer.resources().shared.memory.takenBytes();
        render::ViewRenderer view(renderer);
        fill(view, inputs);
        const uint64_t real = allocated() - shared;
        const uint64_t said = renderer.resources().shared.memory.takenBytes() - taken_before;
        EXPECT_GE(said, real) << name;
        EXPECT_LE(static_cast<double>(said), 1.1 * static_cast<double>(real)) << name;
    }
}

TEST_F(MemoryNeed, GoingToAndFro_HoldsNoMoreThanThePictureOfNow) {
    render::Renderer renderer(device(), *scene_);
    FrameInputs inputs = small();
    inputs.settings.camera = scene_->cameras.at(0).camera;
    render::ViewRenderer view(renderer);
    fill(view, inputs);
    const uint64_t at_first = allocated();
    FrameInputs large = inputs;
    for (const uint32_t width : {1280U, 1296U, 1312U}) { // a set of targets for each slot, once
        large.settings.size = {width, 720};
        fill(view, large);
    }
    ASSERT_TRUE(view.submit(inputs));
    ASSERT_TRUE(view.collect());
    EXPECT_LE(allocated(), at_first);
}

TEST_F(MemoryNeed, PictureBeyondTheSession_IsRefusedWithFiguresAndAllocatesNothing) {
    render::Renderer renderer(device(), *scene_, {.session_bytes = 24U << 20U});
    FrameInputs inputs = small();
    inputs.settings.camera = scene_->cameras.at(0).camera;
    render::ViewRenderer view(renderer);
    fill(view, inputs);
    const uint64_t before = allocated();
    FrameInputs large = inputs;
    large.settings.size = {4096, 4096};
    large.settings.shadows = {.light_count = 32, .size_px = 512};
    large.settings.bloom.kind = settings::BloomKind::kMipChain;
    const auto refused = view.submit(large);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
    EXPECT_THAT(refused.error().message,
                testing::MatchesRegex("a picture of 4096x4096 with shadow maps of 32 lights and "
                                      "bloom takes [0-9]+ MiB of memory; a session may have 24; "
                                      "use a smaller picture"));
    EXPECT_LE(allocated(), before);
    fill(view, inputs); // the last good picture still comes
}

TEST_F(MemoryNeed, PictureBeyondTheDevice_IsRefusedUntilAnotherViewGoes) {
    FrameInputs inputs = small();
    inputs.settings.camera = scene_->cameras.at(0).camera;
    const auto [scene_bytes, view_bytes] = [&] {
        render::Renderer renderer(device(), *scene_);
        const auto& memory = renderer.resources().shared.memory;
        const uint64_t scene = memory.takenBytes();
        render::ViewRenderer view(renderer);
        fill(view, inputs);
        return std::pair(scene, memory.takenBytes() - scene);
    }();
    render::Renderer renderer(device(), *scene_,
                              {.device_bytes = scene_bytes + view_bytes * 3 / 2});
    render::ViewRenderer second(renderer);
    {
        render::ViewRenderer first(renderer);
        fill(first, inputs);
        const auto refused = second.submit(inputs);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
        EXPECT_THAT(refused.error().message, testing::HasSubstr("scenes and other sessions use"));
    }
    fill(second, inputs);
}

TEST_F(MemoryNeed, WhatEncodesThePicture_CountsToo) {
    render::Renderer renderer(device(), *scene_, {.session_bytes = 24U << 20U});
    FrameInputs inputs = small();
    inputs.settings.camera = scene_->cameras.at(0).camera;
    inputs.beside_bytes = 24U << 20U;
    render::ViewRenderer view(renderer);
    ASSERT_FALSE(view.submit(inputs));
    inputs.beside_bytes = 0;
    fill(view, inputs);
}

} // namespace froxel::test
