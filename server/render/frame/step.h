// The shape of a step: how a frame that has it meets it, in the order of the frame's way. A step is
// a file or two in steps/, which end in a StepRow, and a line in steps/order.h. What all views
// share of it, such as pipelines, is SceneResources::shared.stored(); what a frame slot keeps of
// it, such as descriptor sets, FrameSlot::stored; what it draws into besides its view's targets
// FrameSlot::step_targets.
#pragma once

#include "core/error.h"
#include "core/frame_stats.h"
#include "core/host_form.h"
#include "light/frame_lights.h"
#include "render/frame/debug_frame.h"
#include "render/frame/draw_list.h"
#include "render/frame/frame_blocks.h"
#include "render/frame/frame_plan.h"
#include "render/frame/scene_pose.h"

#include <memory>
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

// What the host knows of a frame that was built.
struct StepInputs {
    const settings::ViewSettings& settings; // their size: what is drawn
    FrameSize size;
    const ScenePose& pose;
    const light::FrameLights& lights;
    const DrawList& draws;
    const DebugFrame& debug; // of a frame with a debug view
    const HostForm& form;    // of the picture
    double time_s = 0;
    bool keeps = false; // what rests since the frame before need not be drawn again
};

// One view's, made when a frame first has it. Only frames that have it call it, but for
// freeTargets(). Render thread.
class Step {
  public:
    Step() = default;
    virtual ~Step() = default;
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

    // Before a frame is planned, where its row asks for it: tells the plan what there is.
    virtual void look(const StepInputs& /*inputs*/, FrameFacts& /*facts*/) {}
    // From now on it is about a frame with this plan; see build().
    [[nodiscard]] Result<void>
    begin(const StepInputs& inputs, const FramePlan& frame, const StepPlan& plan) {
        plan_ = plan;
        return build(inputs, frame);
    }
    // Whether what it would draw is there from the view's frame before.
    [[nodiscard]] virtual bool holds() const { return false; }
    // What it is to the cost of other passes.
    virtual void addLoad(const UnitCosts& /*unit*/, CostInputs& /*load*/) const {}
    // Its passes, in order.
    virtual void addCosts(const FrameCosts& /*costs*/,
                          std::vector<PassEstimate>& /*passes*/) const {}
    // Of one pixel's loop over lights, where it has one: seconds a light.
    [[nodiscard]] virtual double loopCost(const FrameCosts& /*costs*/) const { return 0; }
    // What it draws into besides its view's targets.
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

    // Records its passes, with barriers between them; those before the first and after the last
    // follow from its uses. May throw VariantsMissing.
    virtual void record(const FrameContext& /*frame*/) const {}

    // What the device found out, of the slot's frame, which has finished, and `its` plan in it: by
    // then the step may be at a later frame.
    virtual void
    addResults(const FrameSlot& /*slot*/, const StepPlan& /*its*/, FrameStats& /*stats*/) const {}

  protected:
    // The host's part of a frame. Errors: kCapacity, kUnsupported. May throw VariantsMissing,
    // vk::SystemError.
    [[nodiscard]] virtual Result<void> build(const StepInputs& /*inputs*/,
                                             const FramePlan& /*frame*/) {
        return {};
    }
    // Of that frame.
    [[nodiscard]] const StepPlan& plan() const { return plan_; }

  private:
    StepPlan plan_;
};

// StepRow::make of a step whose constructor takes the scene.
template <class T>
[[nodiscard]] std::unique_ptr<Step> makeStep(SceneResources& scene) {
    return std::make_unique<T>(scene);
}

// Of a frame, in its order: FramePlan::steps.
struct ActiveStep {
    Step* step = nullptr;
    bool reused = false; // PlannedStep::reused
    StepPlan plan = {};
};

} // namespace froxel::render
