// What a moving view does without, so that it keeps a frame rate that the renderer would miss as it
// was asked to draw. Pure; one thread at a time.
//
// Where the scene has coarser levels, first a geometry error, as small as does it; then resolution.
// Down at once to the scale whose frames fit by their area, and to one error after the other, since
// only trying tells what one saves; where errors save nothing, there are none. Up by one step, and
// only where the next one's frames would clearly fit, so that it does not swing. A step up that
// failed is held for longer each time.
#pragma once

#include "core/clock.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace froxel::session {

struct Relief {
    double scale = 1; // of each side
    double geometry_error_px = 0;
    bool operator==(const Relief&) const = default;
};

class RateKeeper {
  public:
    static constexpr std::array kScales = {1.0, 0.85, 0.7, 0.6, 0.5, 0.4};
    static constexpr std::array kErrors_px = {0.0, 0.5, 1.0, 2.0};

    // fps: 0: none. coarser_levels: the scene has them. Back to no relief where either changes.
    void setTarget(double fps, bool coarser_levels);
    // What a frame of a moving view took that was drawn so.
    void onFrame(Seconds cost, const Relief& with, TimePoint now);
    [[nodiscard]] Relief relief() const { return {kScales[step_.scale], kErrors_px[step_.error]}; }

  private:
    struct Step {
        size_t scale = 0; // of kScales
        size_t error = 0; // of kErrors_px
    };

    void moveTo(Step step, TimePoint now);
    void giveMore(TimePoint now);
    [[nodiscard]] Seconds costAtScale(size_t scale) const;

    double fps_ = 0;
    bool levels_ = false;
    bool errors_help_ = true; // as far as is known
    Step step_;
    std::optional<Seconds> cost_; // smoothed, at this step
    uint32_t seen_ = 0;
    Seconds left_at_{0}; // what frames took at the error before when this one was tried
    // Of each error: how many times as long frames took at the one before.
    std::array<double, kErrors_px.size()> saves_{};
    TimePoint moved_at_;
    bool climbed_ = false; // the last move was up
    Seconds hold_{0};      // before the next one up
};

} // namespace froxel::session
