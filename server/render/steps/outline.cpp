// Edges of depth and normals darkened, before anything is blended.
#include "embedded.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/screen_pass.h"

namespace froxel::render {

namespace {

struct OutlinePipelines : ScreenPipelines {
    explicit OutlinePipelines(DeviceResources& shared)
        : ScreenPipelines(
              shared, [](const VariantKey&) { return shaders::outline_comp(); }, pass::kOutline) {}
};

class Outline final : public Step {
  public:
    explicit Outline(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kOutline, timeOver(costs.screen(), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), frame.costs.screen(),
                [](const FrameContext& at, const vk::Rect2D& part) {
                    recordScreenPass<OutlinePipelines>(at, pass::kOutline,
                                                       {0, 0, at.plan.gbuffer_output_flags}, part);
                });
    }
};

} // namespace

const StepRow kOutlineStep{
    .name = pass::kOutline,
    .part = StepPart::kPicture,
    .plan =
        [](const PlanInputs& inputs) {
            return isToon(inputs.settings.renderer) && inputs.settings.toon_outline.strength > 0
                       ? std::optional(StepPlan{})
                       : std::nullopt;
        },
    .uses =
        [](const FramePlan&, const StepPlan&) {
            return std::vector{use::sampled(Resource::kDepth), use::sampled(Resource::kGbuffer),
                               use::stored(Resource::kRadiance)};
        },
    .words =
        [](const PlanInputs&, const StepPlan* plan) {
            return std::string(plan != nullptr
                                   ? "outline: a separate pass darkens edges of depth and normals"
                                   : "");
        },
    .make = makeStep<Outline>};

} // namespace froxel::render
