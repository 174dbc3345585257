// The environment, where nothing covers it.
#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/pipelines/shared_pipeline.h"
#include "render/steps/environment.h"
#include "render/steps/order.h"
#include "render/surfaces/screen_pass.h"

namespace froxel::render {

namespace {

// Shared by every view.
struct BackgroundPipeline {
    explicit BackgroundPipeline(const DeviceResources& shared)
        : pipeline(gpu::makeComputePipeline(shared.device,
                                            shaders::background_comp(),
                                            {},
                                            shared.pipelines.screenPipelineLayout(),
                                            "background")) {}

    SharedPipeline pipeline;
};

class Background final : public Step {
  public:
    explicit Background(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kBackground, timeOver(costOf(costs), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), costOf(frame.costs), recordPart);
    }

  private:
    static RegionCost costOf(const FrameCosts& costs) {
        const double each = costs.unit().screen_pixel + onDevice(costs.unit(), kEnvironmentLookup);
        return {Seconds(0),
                [each](const vk::Rect2D& region) { return Seconds(areaOf(region) * each); }};
    }
    static void recordPart(const FrameContext& frame, const vk::Rect2D& region) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kBackground);
        const auto& cmd = frame.slot.cmd;
        frame.scene.shared.stored<BackgroundPipeline>().pipeline.bind(cmd,
                                                                      frame.scene.shared.variants);
        bindScreenSets(frame, vk::PipelineBindPoint::eCompute);
        dispatchOver(cmd, region);
    }
};

std::optional<StepPlan> planOfBackground(const PlanInputs& inputs) {
    return hasEnvironment(inputs.settings) && inputs.settings.environment.background
               ? std::optional(StepPlan{})
               : std::nullopt;
}

} // namespace

const StepRow kBackgroundStep{
    .name = pass::kBackground,
    .part = StepPart::kPicture,
    .plan = planOfBackground,
    .uses =
        [](const FramePlan&, const StepPlan&) {
            return std::vector{use::sampled(Resource::kDepth), use::stored(Resource::kRadiance)};
        },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(
                plan != nullptr
                    ? "background: a separate pass shows the environment behind the scene"
                    : "");
        },
    .make = makeStep<Background>};

} // namespace froxel::render
