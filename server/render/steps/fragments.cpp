// What a debug view shows of fragments that pass the depth test, in the radiance target: how many
// there are, added up, or whose the nearest is.
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"

#include <array>

namespace froxel::render {

namespace {

class Fragments final : public Step {
  public:
    explicit Fragments(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kFragments, timeOver(costs.surfaces(), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), frame.costs.surfaces(), recordPart);
    }

  private:
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        using LoadOp = vk::AttachmentLoadOp;
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kFragments);
        const std::array colors = {
            attachment(frame.slot.targets->radiance, LoadOp::eClear, nothing())};
        const auto depth = attachment(frame.slot.targets->depth, LoadOp::eClear, farDepth());
        const Rendering rendering(frame, part, colors, &depth);
        if (frame.plan.debug == settings::DebugView::kOverdraw) {
            drawGroups(frame, GeometryPass::kOverdraw, frame.draws.solid);
            return;
        }
        drawGroups(frame, GeometryPass::kInstances, frame.draws.solid);
        for (const LayeredDraws* draws : {&frame.draws.transmissive, &frame.draws.transparent}) {
            if (!draws->groups.empty()) {
                drawGroups(frame, GeometryPass::kInstances, draws->groups);
            }
        }
    }
};

} // namespace

const StepRow kFragmentsStep{.name = pass::kFragments,
                             .plan =
                                 [](const PlanInputs& inputs) {
                                     return inputs.plan.solid == Solid::kFragments
                                                ? std::optional(StepPlan{})
                                                : std::nullopt;
                                 },
                             .uses =
                                 [](const FramePlan&, const StepPlan&) {
                                     return std::vector{use::vertices(), use::depthTested(),
                                                        use::drawn(Resource::kRadiance)};
                                 },
                             .make = makeStep<Fragments>};

} // namespace froxel::render
