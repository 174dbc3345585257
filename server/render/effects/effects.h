// The effects of one view.
#pragma once

#include "render/frame/effect.h"
#include "render/frame/frame_plan.h"

#include <map>
#include <memory>
#include <span>
#include <vector>

namespace froxel::render {

// Effects that frames of a view have had. Render thread.
class ViewEffects {
  public:
    explicit ViewEffects(SceneResources& scene) : scene_(scene) {}

    // Before a frame is planned: what effects must see of it.
    void look(const EffectInputs& inputs, FrameFacts& facts);
    // Builds those of the plan. Errors: kCapacity, kUnsupported. Throws VariantsMissing,
    // vk::SystemError.
    [[nodiscard]] Result<void> build(const FramePlan& plan, const EffectInputs& inputs);
    // Of the frame built last, in its order.
    [[nodiscard]] std::span<const ActiveEffect> ofFrame() const { return of_frame_; }
    // Frees targets that this frame has no use for; see Effect::freeUnfit().
    void freeUnfit(const ViewTargets* view);
    void freeTargets();
    // Null: no frame has had it.
    [[nodiscard]] const Effect* find(const EffectRow& row) const {
        const auto at = made_.find(&row);
        return at != made_.end() ? at->second.get() : nullptr;
    }

  private:
    [[nodiscard]] Effect& findOrMake(const EffectRow& row);

    SceneResources& scene_;
    std::map<const EffectRow*, std::unique_ptr<Effect>> made_;
    std::vector<ActiveEffect> of_frame_;
};

} // namespace froxel::render
