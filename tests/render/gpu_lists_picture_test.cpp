// Frames drawn with lists from the device against frames with lists from the host.
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <cstring>

namespace froxel::test {

namespace {

class GpuAssignmentFrames : public GpuTest {
  protected:
    static render::FrameInputs inputsFor(const scene::Scene& scene, render::AssignmentPlace place) {
        render::FrameInputs inputs;
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.settings.size = {120, 68};
        inputs.settings.light_loop = settings::LightLoop::kLists;
        inputs.settings.grid = {.automatic = false, .size = {16, 9, 24}, .law = {}};
        inputs.settings.lights.count = 400;
        inputs.time_s = 3.25;
        inputs.assignment = place;
        return inputs;
    }
};

void expectSamePictures(const Picture& device, const Picture& host) {
    EXPECT_EQ(differingFloats(device, host), 0U);
    EXPECT_EQ(device.rgba8, host.rgba8);
    EXPECT_EQ(device.stats.lists.entry_count, host.stats.lists.entry_count);
    EXPECT_EQ(device.stats.lists.largest, host.stats.lists.largest);
    EXPECT_EQ(device.stats.lists.p95, host.stats.lists.p95);
    EXPECT_EQ(device.stats.lists.why, host.stats.lists.why);
}

std::vector<std::string> assignPasses(const Picture& picture) {
    std::vector<std::string> names;
    for (const PassTime& pass : picture.stats.passes) {
        if (pass.name.rfind("assign_", 0) == 0) {
            names.push_back(pass.name);
        }
    }
    return names;
}

} // namespace

TEST_F(GpuAssignmentFrames, EveryRenderer_DrawsTheSamePicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    render::ViewRenderer view_in_passes(renderer, {.line_entries = 0});
    for (const auto kind :
         {settings::Renderer::kForwardPlus, settings::Renderer::kClusteredDeferred,
          settings::Renderer::kToonCompute}) {
        auto inputs = inputsFor(scene, render::AssignmentPlace::kHost);
        inputs.settings.renderer = kind;
        const Picture host = draw(view, inputs);
        inputs.assignment = render::AssignmentPlace::kDevice;
        const Picture device = draw(view, inputs);
        expectSamePictures(device, host);
        EXPECT_EQ(assignPasses(device), std::vector<std::string>{"assign_lines"});
        const Picture in_passes = draw(view_in_passes, inputs);
        expectSamePictures(in_passes, host);
        EXPECT_EQ(assignPasses(in_passes),
                  (std::vector<std::string>{"assign_count", "assign_scan", "assign_fill",
                                            "assign_order"}));
    }
}

// The first frames do not fit; none that is shown lacks a light, also where newer ones are in
// flight already.
TEST_F(GpuAssignmentFrames, TooLittleRoom_IsDrawnAgainBeforeItIsShown) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    const auto host_inputs = inputsFor(scene, render::AssignmentPlace::kHost);
    const Picture host = draw(renderer, host_inputs);
    render::ViewRenderer view(renderer, {.first_entries = 1, .first_tasks = 1, .line_entries = 0});
    auto inputs = inputsFor(scene, render::AssignmentPlace::kDevice);
    inputs.outputs = {Output::kRadiance};
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(view.submit(inputs));
    }
    for (int i = 0; i < 3; ++i) {
        const auto frame = view.collect();
        ASSERT_TRUE(frame);
        const PixelView& pixels = frame->pixels.view();
        EXPECT_EQ(std::memcmp(pixels.data, host.rgba8.data(), host.rgba8.size()), 0);
        EXPECT_GT(frame->stats.lists.redraw_count, 0U);
        EXPECT_EQ(frame->stats.lists.entry_count, host.stats.lists.entry_count);
    }
    const Picture settled = draw(view, inputs);
    expectSamePictures(settled, host);
    EXPECT_EQ(settled.stats.lists.redraw_count, 0U);
}

TEST_F(GpuAssignmentFrames, MoreTasksThanMayBe_AreAssignedOnTheHost) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer, {.first_tasks = 1, .line_entries = 0, .max_tasks = 2});
    const Picture device = draw(view, inputsFor(scene, render::AssignmentPlace::kDevice));
    expectSamePictures(device, draw(renderer, inputsFor(scene, render::AssignmentPlace::kHost)));
}

TEST_F(GpuAssignmentFrames, LightsThatComeAndGo_LeaveNoStaleLists) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const uint32_t count : {500U, 3U, 0U, 500U}) {
        auto inputs = inputsFor(scene, render::AssignmentPlace::kHost);
        inputs.settings.lights.count = count;
        const Picture host = draw(renderer, inputs);
        inputs.assignment = render::AssignmentPlace::kDevice;
        EXPECT_EQ(differingFloats(draw(view, inputs), host), 0U) << count;
    }
}

} // namespace froxel::test
