// Light lists, where the device makes them.
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/lists/assign_passes.h"
#include "render/pipelines/pass_names.h"
#include "render/steps/order.h"

namespace froxel::render {

namespace {

class Lists final : public Step {
  public:
    explicit Lists(SceneResources& /*scene*/) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({pass::kAssign, timeOf(costs)});
    }
    void record(const FrameContext& frame) const override {
        frame.pieces.add(timeOf(frame.costs));
        recordAssignment({frame.slot.cmd, *frame.scene.shared.assignment(), *frame.slot.assignment},
                         frame.slot.timestamps);
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        light_count_ = static_cast<uint32_t>(inputs.lights.lights.size());
        return {};
    }
    [[nodiscard]] Seconds timeOf(const FrameCosts& costs) const {
        return Seconds(costs.unit().assign + light_count_ * costs.unit().assign_light);
    }

    uint32_t light_count_ = 0;
};

} // namespace

const StepRow kListsStep{
    .name = pass::kAssign,
    .plan =
        [](const PlanInputs& inputs) {
            // A debug view that shows no lists looks at none.
            return inputs.facts.lists == ListPlace::kDevice ? std::optional(StepPlan{})
                                                            : std::nullopt;
        },
    .uses = [](const FramePlan&,
               const StepPlan&) { return std::vector{use::stored(Resource::kLists)}; },
    .make = makeStep<Lists>};

} // namespace froxel::render
