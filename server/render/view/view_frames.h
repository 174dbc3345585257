// One view's frames, from what is asked for to recorded commands and from finished ones to pixels:
// the host's part, the targets that frames share, and what a slot needs. Render thread.
#pragma once

#include "render/frame/frame_slot.h"
#include "render/steps/view_steps.h"
#include "render/view/host_work.h"
#include "render/view/memory_report.h"
#include "render/view/renderer.h"

#include <memory>
#include <optional>
#include <vector>

namespace froxel::render {

class ViewFrames {
  public:
    ViewFrames(SceneResources& scene_in, const ListLimits& limits, const WorkLimits& work_limits)
        : scene_(scene_in), work_(work_limits), host_work_(scene_in, limits), steps_(scene_in),
          memory_(scene_in.shared.memory) {}

    using Slots = std::vector<std::unique_ptr<FrameSlot>>;

    ~ViewFrames() { scene_.shared.variants.forget(this); }
    ViewFrames(const ViewFrames&) = delete;
    ViewFrames& operator=(const ViewFrames&) = delete;

    enum class Made : uint8_t {
        kFrame,  // in flight from now on
        kHalf,   // goes on with the next call for the same inputs: see WorkLimits::host
        kNothing // variants that it needs are still being made
    };
    // Builds a frame and records its pieces into a free slot, one of `slots`, which are all of the
    // view's. Errors: kCapacity, kUnsupported. Throws vk::SystemError.
    [[nodiscard]] Result<Made>
    record(FrameSlot& slot, const FrameInputs& inputs, const Slots& slots);
    // See ViewRenderer::setPieceShare().
    void setPieceShare(double share) { piece_share_ = share; }
    // See ViewRenderer::setPace().
    void setPace(const WorkPace& pace) { pace_ = pace; }
    // What a recorded frame takes by its estimate, of the longest that one may take.
    [[nodiscard]] double limitShare(const FrameSlot& slot) const {
        return slot.pieces.estimate() / limits().frame;
    }
    // Whether what the device told of a completed frame's lists lets it be shown.
    [[nodiscard]] bool accepts(const FrameSlot& slot) {
        return !slot.device_lists || host_work_.lightWork().accept(*slot.assignment);
    }
    // The picture of a completed frame and what is known of it. Throws vk::SystemError.
    [[nodiscard]] RenderedFrame finish(FrameSlot& slot);
    void freeTargets();

    // Of the frame recorded last; null: none, or none of that.
    [[nodiscard]] const ViewTargets* targets() const { return targets_.get(); }
    [[nodiscard]] MaterialSet& materialSet() const { return *host_work_.pose().materialSet(); }
    [[nodiscard]] Detail detail() const {
        return scene_.detailOf(host_work_.stepInputs().settings.geometry_error_px);
    }
    [[nodiscard]] const ViewSteps& steps() const { return steps_; }
    // Of the passes of the frame begun last.
    [[nodiscard]] const std::vector<PassEstimate>& prices() const { return prices_; }

  private:
    // Both at the present pace.
    [[nodiscard]] UnitCosts unitCosts() const {
        return scaled(scene_.shared.unit_costs, pace_.pace, pace_.pace);
    }
    [[nodiscard]] WorkLimits limits() const {
        WorkLimits limits = work_;
        limits.frame *= pace_.frame_share;
        limits.piece *= std::min(1.0, pace_.pace);
        return limits;
    }
    // Whether the frame is recorded; else its host's part is not whole yet. Throws VariantsMissing
    // besides.
    [[nodiscard]] Result<bool>
    recordNow(FrameSlot& slot, const FrameInputs& asked, const Slots& slots);
    // The host's part, all of it or its next stage: whether it is done. `inputs`: what was asked
    // for, at the size that is drawn. Errors: kCapacity.
    [[nodiscard]] Result<bool> build(const FrameInputs& inputs);
    // Throws VariantsMissing besides.
    [[nodiscard]] Result<void> recordBuilt(FrameSlot& slot,
                                           const FrameInputs& inputs,
                                           const FrameSize& size,
                                           const Slots& slots);
    // Asks the budget for a frame that was built, before anything is allocated for it. Errors:
    // kCapacity.
    [[nodiscard]] Result<void>
    takeMemory(FrameSlot& slot, const FramePlan& plan, const FrameSize& size, const Slots& slots);
    // Whether the view's targets hold the surfaces of the frame that was built.
    [[nodiscard]] bool holdsSurfaces(const FramePlan& plan, const FrameSize& size) const;
    // What they hold once the frame that was recorded has run.
    void noteDrawn(const FramePlan& plan, const SurfacesDrawn& surfaces);
    void prepareTargets(FrameSlot& slot, const FramePlan& plan, const FrameSize& size);
    void noteBuilt(FrameSlot& slot, const FramePlan& plan, const FrameInputs& inputs);

    SceneResources& scene_;
    const WorkLimits work_;
    double piece_share_ = 1;
    WorkPace pace_;
    HostWork host_work_;
    std::chrono::steady_clock::time_point started_; // what it builds
    double built_us_ = 0;                           // of the host, spent on that
    ViewSteps steps_;
    MemoryShare memory_;
    TargetNeeds target_needs_; // of the frame that memory was taken for last
    std::shared_ptr<ViewTargets> targets_;
    FrameDetailsKeeper details_;
    std::vector<PassEstimate> prices_;
};

} // namespace froxel::render
