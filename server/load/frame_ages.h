// How old one viewer's pictures are when their last byte is there, counted from the start of
// drawing. Pure.
//
// A frame that shows a new command tells it: latency without the wait on the server, with the
// command's way up in it. Of any other frame only the stages on the server are told, not its way
// down. The lights' clock, which is read when drawing starts, gives that but for how far it is
// from the viewer's clock, which is taken from this viewer's own frames:
//
//   where some show commands: what makes the clock's ages equal to theirs at the least;
//   where none does, as in a room's watcher: what makes no frame younger than its stages. Ages are
//   then lower bounds, by the way down of the frame that was fastest on it.
//
// While the lights' clock stands, and after it was set, an age is the stages alone: a lower bound.
#pragma once

#include "core/clock.h"
#include "froxel/v1/server.pb.h"

#include <optional>
#include <vector>

namespace froxel::load {

// From the start of drawing to the socket.
[[nodiscard]] double stagesMs(const v1::FrameHeader& header);

class FrameAges {
  public:
    // `clock_rate`: the lights' seconds in one of the viewer's; 0: their clock stands.
    explicit FrameAges(double clock_rate = 0) : clock_rate_(clock_rate) {}

    // It jumps, or runs otherwise from now on.
    void forgetClock() { clock_rate_ = 0; }
    // `age_ms`: by the command that it shows for the first time; none: it shows none.
    void onFrame(const v1::FrameHeader& header, TimePoint now, std::optional<double> age_ms);

    // In the order of the frames.
    [[nodiscard]] std::vector<double> all() const;

  private:
    struct Drawn {
        double stages_ms = 0;
        std::optional<double> clock_ms; // since the lights' clock stood at 0; of an unknown zero
        std::optional<double> age_ms;
    };
    // What `clock_ms` has to be added to for an age.
    [[nodiscard]] std::optional<double> clockOffset() const;

    double clock_rate_;
    std::vector<Drawn> frames_;
};

} // namespace froxel::load
