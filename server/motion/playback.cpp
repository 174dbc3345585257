#include "motion/playback.h"

#include "core/assert.h"

#include <algorithm>
#include <utility>

namespace froxel::motion {

namespace {

double speedOf(const settings::Animation& animation) {
    return animation.playing ? static_cast<double>(animation.speed) : 0;
}

// Of Motion::clips; scene::kNone: the rest pose.
uint32_t clipOf(const settings::Animation& animation) {
    return animation.number == 0 ? scene::kNone : animation.number - 1;
}

PlayedClip begun(const settings::Animation& animation, double now_s, const Fade& fade) {
    return {.clip = clipOf(animation),
            .clock = {now_s, 0, speedOf(animation), animation.repeat},
            .fade = fade,
            .covers = true};
}

} // namespace

Playback::Playback(std::shared_ptr<const scene::Motion> motion,
                   const settings::Animation& animation,
                   double now_s)
    : motion_(std::move(motion)) {
    if (motion_) {
        clips_.push_back(begun(animation, now_s, {}));
    }
}

double Playback::durationOf(const PlayedClip& played) const {
    return played.clip == scene::kNone ? 0 : motion_->clips[played.clip].duration_s;
}

void Playback::follow(const settings::Animation& animation, double now_s) {
    if (!motion_) {
        return;
    }
    const double speed = speedOf(animation);
    for (PlayedClip& played : clips_) {
        ClipClock& clock = played.clock;
        if (clock.repeat != animation.repeat) {
            clock = clock.withPhase(now_s, clock.timeAt(now_s, durationOf(played)));
            clock.repeat = animation.repeat;
            clock = clock.anchoredAt(now_s, durationOf(played));
        }
        if (clock.speed != speed) {
            clock = clock.anchoredAt(now_s, durationOf(played)).withSpeed(now_s, speed);
        }
    }
    if (clips_.back().clip == clipOf(animation)) {
        return;
    }
    clips_.push_back(begun(animation, now_s, {now_s, static_cast<double>(animation.fade_s)}));
    // Before the last that is all there, nothing weighs anything any more.
    while (clips_.size() > 1 && std::any_of(clips_.begin() + 1, clips_.end(), [&](const auto& one) {
               return one.fade.isOverAt(now_s);
           })) {
        clips_.erase(clips_.begin());
    }
    if (clips_.size() > kMostClips) {
        clips_.erase(clips_.begin());
        clips_.front().fade = {};
    }
}

void Playback::seek(double clip_s, double now_s) {
    FROXEL_ASSERT(!clips_.empty() && clips_.back().clip != scene::kNone, "a clip is chosen");
    clips_.back().clock = clips_.back().clock.withPhase(now_s, clip_s);
}

std::optional<Playing> Playback::at(double now_s) const {
    return motion_ ? std::optional(Playing{clips_, now_s}) : std::nullopt;
}

std::optional<double> Playback::timeAt(double now_s) const {
    if (clips_.empty() || clips_.back().clip == scene::kNone) {
        return {};
    }
    return clips_.back().clock.timeAt(now_s, durationOf(clips_.back()));
}

std::optional<double> Playback::pausedAt() const {
    const bool paused = !clips_.empty() && clips_.back().clock.speed == 0;
    return paused ? timeAt(clips_.back().clock.anchor_s) : std::nullopt;
}

bool Playback::movesAt(double now_s) const {
    const auto moves = [&](const PlayedClip& played) {
        return !played.clock.restsAt(now_s, durationOf(played));
    };
    if (clips_.empty()) {
        return false;
    }
    return moves(clips_.back()) || !clips_.back().fade.isOverAt(now_s);
}

} // namespace froxel::motion
