// Depth of solid surfaces, before a pass that draws them again, or alone for a debug view.
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"
#include "render/surfaces/counting_step.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"

namespace froxel::render {

namespace {

class DepthPrepass final : public CountingStep {
  public:
    using CountingStep::CountingStep;

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kDepthPrepass, timeOver(costs.depth(), costs.load().size.drawn)});
    }
    void record(const FrameContext& frame) const override {
        restart(frame);
        inParts(frame, frame.drawn(), frame.costs.depth(),
                [this](const FrameContext& at, const vk::Rect2D& part) { recordPart(at, part); });
    }

  private:
    void recordPart(const FrameContext& frame, const vk::Rect2D& part) const {
        inGroups(
            frame, GeometryPass::kDepth, frame.draws.solid, [&](const auto& groups, bool first) {
                const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd,
                                           pass::kDepthPrepass);
                const Samples samples(frame, counts());
                const auto depth = attachment(
                    frame.slot.targets->depth,
                    first ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad, farDepth());
                const Rendering rendering(frame, part, {}, &depth);
                drawGroups(frame, GeometryPass::kDepth, groups);
            });
    }
};

std::optional<StepPlan> planOfDepth(const PlanInputs& inputs) {
    const FramePlan& frame = inputs.plan;
    const bool alone = frame.solid == Solid::kShownDepth;
    const bool before = frame.solid != Solid::kFragments && inputs.facts.prepass_pays &&
                        inputs.settings.renderer != settings::Renderer::kNaive;
    return !frame.byIds() && (alone || before)
               ? std::optional(StepPlan{.way = countingWay(frame, false)})
               : std::nullopt;
}

std::string wordsOfDepth(const PlanInputs& inputs, const StepPlan* plan) {
    if (inputs.plan.byIds() || inputs.plan.solid == Solid::kFragments) {
        return {};
    }
    if (plan != nullptr) {
        return "depth prepass: each pixel is shaded once";
    }
    return inputs.settings.renderer == settings::Renderer::kNaive ? "naive: no depth prepass"
           : inputs.facts.overdraw_unknown ? "no depth prepass: overdraw is being measured"
                                           : "no depth prepass: it would cost more than it saves";
}

} // namespace

const StepRow kDepthStep{.name = pass::kDepthPrepass,
                         .plan = planOfDepth,
                         .uses =
                             [](const FramePlan&, const StepPlan&) {
                                 return std::vector{use::vertices(), use::depthTested()};
                             },
                         .words = wordsOfDepth,
                         .make = makeStep<DepthPrepass>};

} // namespace froxel::render
