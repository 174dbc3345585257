// What the steps have in common that raster solid surfaces: whichever draws depth first may count
// the fragments that pass the depth test, until the scene's overdraw is known.
#pragma once

#include "gpu/sample_counter.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"

namespace froxel::render {

// Of StepPlan::way.
inline constexpr uint32_t kAfterDepth = 1U << 0U; // the depth step left the same depth
inline constexpr uint32_t kCountsSamples = 1U << 1U;

// The way of a pass that writes depth unless `after_depth`.
[[nodiscard]] inline uint32_t countingWay(const FramePlan& frame, bool after_depth) {
    return (after_depth ? kAfterDepth : 0U) |
           (frame.count_samples && !after_depth ? kCountsSamples : 0U);
}

class CountingStep : public Step {
  public:
    explicit CountingStep(SceneResources& scene) : scene_(scene) {}

    void prepare(FrameSlot& slot, FrameBlocks& /*blocks*/) override {
        if (counts()) {
            (void)slot.stored.findOrMake<gpu::SampleCounter>(scene_.shared.device);
        }
    }
    void
    addResults(const FrameSlot& slot, const StepPlan& its, FrameStats& /*stats*/) const override {
        if ((its.way & kCountsSamples) != 0) {
            const auto& drawn = slot.targets->size.drawn;
            scene_.overdraw = static_cast<double>(slot.stored.get<gpu::SampleCounter>().read()) /
                              (static_cast<double>(drawn.width_px) * drawn.height_px);
        }
    }

  protected:
    [[nodiscard]] bool counts() const { return (plan().way & kCountsSamples) != 0; }
    [[nodiscard]] bool afterDepth() const { return (plan().way & kAfterDepth) != 0; }
    void restart(const FrameContext& frame) const {
        if (counts()) {
            frame.slot.stored.get<gpu::SampleCounter>().restart();
        }
    }
    // Counts as long as it lives, where samples are counted; outside of rendering.
    class Samples {
      public:
        Samples(const FrameContext& frame, bool counts)
            : counter_(counts ? &frame.slot.stored.get<gpu::SampleCounter>() : nullptr),
              cmd_(frame.slot.cmd) {
            if (counter_ != nullptr) {
                counter_->begin(cmd_);
            }
        }
        ~Samples() {
            if (counter_ != nullptr) {
                counter_->end(cmd_);
            }
        }
        Samples(const Samples&) = delete;
        Samples& operator=(const Samples&) = delete;

      private:
        gpu::SampleCounter* counter_;
        const vk::raii::CommandBuffer& cmd_;
    };

  private:
    SceneResources& scene_;
};

} // namespace froxel::render
