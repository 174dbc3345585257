// Every pass that a frame records has a price, under its own label or under that of the pass whose
// price holds it.
#include "render/frame/frame_costs.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/steps/view_steps.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/step_frames.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace froxel::test {
namespace {

using render::FrameInputs;

class PassNames : public SharedGpuTest {};

TEST_F(PassNames, PassesOfEveryStep_HavePrices) {
    scene::Scene scene = makeRoom();
    scene.materials.at(0).coat = {.strength = 1}; // a layer: the G-buffer has no room for it
    scene.materials.at(4).transmission.strength = 1;
    render::Renderer renderer(device(), scene);
    std::set<std::string> recorded;
    std::set<const render::StepRow*> had;
    for (const auto& [name, change] : stepFrames()) {
        FrameInputs inputs;
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.settings.size = {64, 36};
        inputs.settings.lights.count = 20;
        change(inputs);
        render::ViewRenderer view(renderer);
        const Picture picture = drawPixels(view, inputs);
        EXPECT_FALSE(picture.stats.passes.empty()) << name;
        for (const PassTime& pass : picture.stats.passes) {
            const auto is_price = [&](const render::PassEstimate& price) {
                return price.pass == render::priceOf(pass.name);
            };
            EXPECT_TRUE(std::ranges::any_of(view.prices(), is_price)) << name << ": " << pass.name;
            recorded.insert(pass.name);
        }
        for (const render::StepRow* row : render::kOrder) {
            if (view.steps().find(*row) != nullptr) {
                had.insert(row);
            }
        }
        // Nor is anything priced that is not recorded.
        for (const render::PassEstimate& price : view.prices()) {
            const auto has_price = [&](const PassTime& pass) {
                return render::priceOf(pass.name) == price.pass;
            };
            EXPECT_TRUE(std::ranges::any_of(picture.stats.passes, has_price))
                << name << ": " << price.pass;
        }
    }
    EXPECT_GE(recorded.size(), 30U) << "those frames have most of the passes";
    for (const render::StepRow* row : render::kOrder) {
        const bool elsewhere = row == &render::kPoseStep ||                 // motion_test.cpp
                               (row == &render::kReadbackStep && !onGpu()); // a GPU's
        EXPECT_EQ(had.contains(row), !elsewhere) << row->name << ": step_frames.cpp";
    }
    RecordProperty("labels", static_cast<int>(recorded.size()));
}

} // namespace
} // namespace froxel::test
