// Which viewer is drawn next. Pure: no threads, no clock of its own.
//
// Viewers share the device's time, not the number of frames: each has a virtual time that grows
// with what its frames cost, and the ready one with the least goes first (start-time fair
// queueing, Goyal et al. 1996). A viewer that asks for huge pictures slows itself. One that was
// idle gets no credit for it: it resumes at the virtual time of the frame drawn last.
#pragma once

#include "core/clock.h"

#include <cstdint>
#include <map>
#include <optional>

namespace froxel::stream {

class FrameScheduler {
  public:
    // No viewer gets frames closer together than `min_interval` on average, but for onInput().
    explicit FrameScheduler(Seconds min_interval) : min_interval_(min_interval) {}

    void add(uint64_t viewer);
    void remove(uint64_t viewer);
    enum class Ready : uint8_t {
        kNo,
        kFrame, // has something new to show and room for it, at its pace
        kPiece, // has begun a frame of which pieces wait
    };
    void setReady(uint64_t viewer, Ready ready);

    // A command has come in. Where commands come as evenly as frames, each would wait the same
    // share of an interval for its frame; the viewer's pace is moved so that frames begin just
    // after them, an eighth of an interval at a time and by a whole one a second at most (61 frames
    // instead of 60).
    void onInput(uint64_t viewer, TimePoint now);

    // The ready viewer to draw now; none when all are idle or not due.
    [[nodiscard]] std::optional<uint64_t> next(TimePoint now) const;
    // When the first ready viewer becomes due; may be past.
    [[nodiscard]] std::optional<TimePoint> nextDue() const;

    // The device now works for this viewer.
    void onStarted(uint64_t viewer);
    // On a new frame, which counts for its pace.
    void onFrame(uint64_t viewer, TimePoint now);
    // Device time that this viewer took, or is about to take; negative: took less than that.
    void charge(uint64_t viewer, Seconds cost);

  private:
    struct Entry {
        [[nodiscard]] TimePoint readyAt() const {
            return ready == Ready::kPiece ? TimePoint{} : due;
        }

        Ready ready = Ready::kNo;
        Seconds virtual_time{0};
        TimePoint due{};     // the grid of an even pace; a viewer that kept up stays on it
        Seconds movable{0};  // how much earlier it may yet become,
        TimePoint counted{}; // as of then
    };

    const Seconds min_interval_;
    Seconds virtual_now_{0};
    std::map<uint64_t, Entry> viewers_;
};

} // namespace froxel::stream
