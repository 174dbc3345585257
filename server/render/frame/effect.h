// The shape of an effect: how a frame that has it meets it, in the order of the frame's way. An
// effect is a file or two here, which end in an EffectRow, and a row in effects.cpp. What all views
// share of it, such as pipelines, is SceneResources::shared(); what a frame slot keeps of it, such
// as descriptor sets, FrameSlot::kept; what it draws into FrameSlot::effect_targets.
#pragma once

#include "core/error.h"
#include "core/frame_stats.h"
#include "light/frame_lights.h"
#include "render/frame/effect_plan.h"
#include "render/frame/frame_blocks.h"
#include "render/frame/scene_pose.h"

#include <vector>

namespace froxel::render {

class FrameCosts;
class FrameUpload;
class NeedList;
struct FrameContext;
struct CostInputs;
struct FrameSlot;
struct PassEstimate;
struct UnitCosts;
struct ViewTargets;

// What the host knows of a frame that has effects.
struct EffectInputs {
    const settings::ViewSettings& settings; // their size: what is drawn
    const ScenePose& pose;
    const light::FrameLights& lights;
    double time_s = 0;
    bool keeps = false; // what rests since the frame before need not be drawn again
};

// One view's, made when a frame first has it. Only frames that have it call it, but for
// freeTargets(). Render thread.
class Effect {
  public:
    Effect() = default;
    virtual ~Effect() = default;
    Effect(const Effect&) = delete;
    Effect& operator=(const Effect&) = delete;

    // Before a frame is planned, where its row asks for it: tells the plan what there is.
    virtual void look(const EffectInputs& /*inputs*/, FrameFacts& /*facts*/) {}
    // The host's part; all that follows is about that frame. Errors: kCapacity, kUnsupported. May
    // throw VariantsMissing, vk::SystemError.
    [[nodiscard]] virtual Result<void> build(const EffectInputs& /*inputs*/,
                                             const EffectPlan& /*plan*/) {
        return {};
    }
    // What it is to the cost of other passes.
    virtual void addLoad(const UnitCosts& /*unit*/, CostInputs& /*load*/) const {}
    // Its passes, in order.
    virtual void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const = 0;
    // Of one pixel's loop over lights, where it has one: seconds a light.
    [[nodiscard]] virtual double loopCost(const UnitCosts& /*unit*/) const { return 0; }
    // What it draws into.
    virtual void addMemory(NeedList& /*need*/) const {}
    // What it uploads, and where the frame set finds it; nothing is allocated yet.
    virtual void gather(FrameUpload& /*upload*/, FrameBlocks& /*blocks*/) {}
    virtual void addStats(FrameStats& /*stats*/) const {}

    // Frees targets that the frame has no use for, before others are made; `view`: the view's own
    // where they stay, else null.
    virtual void freeUnfit(const ViewTargets* /*view*/) {}
    virtual void freeTargets() {}
    // Makes what lacks and describes it to the frame set, in `blocks`, and to sets of the slot,
    // which has its targets and its upload. Throws vk::SystemError.
    virtual void prepare(FrameSlot& /*slot*/, FrameBlocks& /*blocks*/) {}

    // Records what it draws for itself, without the picture, with barriers after each pass.
    virtual void recordOwn(const FrameContext& /*frame*/) const {}
    // Records what it does to the picture, with barriers between its passes; those before the first
    // and after the last are frame_recorder's. Both may throw VariantsMissing.
    virtual void record(const FrameContext& /*frame*/) const {}

    // What the device found out, of the slot's frame, which has finished.
    virtual void addResults(const FrameSlot& /*slot*/, FrameStats& /*stats*/) const {}
};

// EffectRow::make of an effect whose constructor takes the scene.
template <class T>
[[nodiscard]] std::unique_ptr<Effect> makeEffect(SceneResources& scene) {
    return std::make_unique<T>(scene);
}

// Of a frame.
struct ActiveEffect {
    EffectPlace place;
    Effect* effect;
};

} // namespace froxel::render
