// The steps of one view.
#pragma once

#include "render/frame/frame_plan.h"
#include "render/frame/step.h"

#include <map>
#include <memory>
#include <span>
#include <vector>

namespace froxel::render {

// Those that frames of a view have had. Render thread.
class ViewSteps {
  public:
    explicit ViewSteps(SceneResources& scene) : scene_(scene) {}

    // Before a frame is planned: what steps must see of it.
    void look(const StepInputs& inputs, FrameFacts& facts);
    // Begins a frame with those of the plan, which from then on says what is reused. Errors:
    // kCapacity, kUnsupported. Throws VariantsMissing, vk::SystemError.
    [[nodiscard]] Result<void> begin(FramePlan& plan, const StepInputs& inputs);
    // Of that frame, in its order.
    [[nodiscard]] std::span<const ActiveStep> ofFrame() const { return of_frame_; }
    // Frees targets that this frame has no use for; see Step::freeUnfit().
    void freeUnfit(const ViewTargets* view);
    void freeTargets();
    // Null: no frame has had it.
    [[nodiscard]] const Step* find(const StepRow& row) const {
        const auto at = made_.find(&row);
        return at != made_.end() ? at->second.get() : nullptr;
    }

  private:
    [[nodiscard]] Step& findOrMake(const StepRow& row);

    SceneResources& scene_;
    std::map<const StepRow*, std::unique_ptr<Step>> made_;
    std::vector<ActiveStep> of_frame_;
};

} // namespace froxel::render
