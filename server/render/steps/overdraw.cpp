// How many fragments of each pixel pass the depth test, added up in the radiance target.
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"

#include <array>

namespace froxel::render {

namespace {

class Overdraw final : public Step {
  public:
    explicit Overdraw(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kOverdraw, timeOver(costs.surfaces(), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        inParts(frame, frame.drawn(), frame.costs.surfaces(), recordPart);
    }

  private:
    static void recordPart(const FrameContext& frame, const vk::Rect2D& part) {
        using LoadOp = vk::AttachmentLoadOp;
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kOverdraw);
        const std::array colors = {
            attachment(frame.slot.targets->radiance, LoadOp::eClear, nothing())};
        const auto depth = attachment(frame.slot.targets->depth, LoadOp::eClear, farDepth());
        const Rendering rendering(frame, part, colors, &depth);
        drawGroups(frame, GeometryPass::kOverdraw, frame.draws.solid);
    }
};

} // namespace

const StepRow kOverdrawStep{.name = pass::kOverdraw,
                            .plan =
                                [](const PlanInputs& inputs) {
                                    return inputs.plan.solid == Solid::kOverdraw
                                               ? std::optional(StepPlan{})
                                               : std::nullopt;
                                },
                            .uses =
                                [](const FramePlan&, const StepPlan&) {
                                    return std::vector{use::vertices(), use::depthTested(),
                                                       use::drawn(Resource::kRadiance)};
                                },
                            .make = makeStep<Overdraw>};

} // namespace froxel::render
