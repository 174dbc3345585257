// The resolution at which a moving view keeps a frame rate that the renderer would miss at the size
// asked for. Pure; one thread at a time.
//
// Down at once to the scale whose frames fit by their area; up by one step, and only where the next
// one's frames would clearly fit, so that it does not swing. A step up that failed is held for
// longer each time.
#pragma once

#include "core/clock.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace froxel::session {

class RenderScale {
  public:
    static constexpr std::array kScales = {1.0, 0.85, 0.7, 0.6, 0.5, 0.4};

    // 0: none. Back to full scale where it changes.
    void setTarget(double fps);
    // What a frame of a moving view took at this scale.
    void onFrame(Seconds cost, double scale, TimePoint now);
    [[nodiscard]] double scale() const { return kScales[step_]; }

  private:
    void moveTo(size_t step, TimePoint now);

    double fps_ = 0;
    size_t step_ = 0;
    std::optional<Seconds> cost_; // smoothed, at this step
    uint32_t seen_ = 0;
    TimePoint moved_at_;
    bool climbed_ = false; // the last move was up
    Seconds hold_{0};      // before the next one up
};

} // namespace froxel::session
