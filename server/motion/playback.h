// Which clips play and where they stand, as a viewer commands it.
#pragma once

#include "motion/pose.h"
#include "settings/settings.h"

#include <memory>
#include <optional>
#include <vector>

namespace froxel::motion {

// What a frame shows of a scene that moves.
struct Playing {
    std::vector<PlayedClip> clips;
    double now_s = 0; // of the clock that they are anchored in

    bool operator==(const Playing&) const = default;
};

// A plain value. Each command moves anchors and nothing else, so what is shown at a time follows
// from the commands and their times: commands of one time that do not name the same thing give the
// same bytes in any order, and reading changes nothing. Speed, repeating and pausing are those of
// all clips, also of those that fade; a fade goes on while clips are paused.
class Playback {
  public:
    // Of a scene that rests: nothing plays.
    Playback() = default;
    // From the clip's beginning at `now_s`. The number is one of the scene's animations, or 0.
    Playback(std::shared_ptr<const scene::Motion> motion,
             const settings::Animation& animation,
             double now_s);

    // Plays on as `animation` says; what it says already stays as it is. Another number begins at
    // its clip's beginning, and covers what played before within fade_s. At most kMostClips play:
    // one more ends the fade of the oldest.
    void follow(const settings::Animation& animation, double now_s);
    // The chosen clip goes on from there: 0 to its duration.
    void seek(double clip_s, double now_s);

    // Absent of a scene that rests.
    [[nodiscard]] std::optional<Playing> at(double now_s) const;
    // The chosen clip's own time; none: no clip is chosen.
    [[nodiscard]] std::optional<double> timeAt(double now_s) const;
    // The same where it is paused.
    [[nodiscard]] std::optional<double> pausedAt() const;
    // Whether any pose after `now_s` is another than that of `now_s`.
    [[nodiscard]] bool movesAt(double now_s) const;
    // Null of a scene that rests.
    [[nodiscard]] const std::shared_ptr<const scene::Motion>& motion() const { return motion_; }

    bool operator==(const Playback&) const = default;

    static constexpr size_t kMostClips = 4;

  private:
    [[nodiscard]] double durationOf(const PlayedClip& played) const;

    std::shared_ptr<const scene::Motion> motion_;
    std::vector<PlayedClip> clips_; // the last is the chosen one
};

} // namespace froxel::motion
