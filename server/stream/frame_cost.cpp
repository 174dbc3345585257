#include "stream/frame_cost.h"

#include "core/keep_for_good.h"
#include "session/affordable_scale.h"
#include "session/delivery.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

namespace froxel::stream {
namespace {

// A slow device ends by the count, or after the first window.
constexpr Seconds kWindow{0.1};
constexpr uint32_t kFewest = 2; // intervals between frames, in each
constexpr Seconds kLongest{2.0};
constexpr double kSteady = 0.98;
// A GPU that was idle for long comes to its clocks late, and not by and by.
constexpr Seconds kWarmUp{1.0};

// Seen from a little farther round the target: what a view that rests may keep, a moving one draws.
settings::Camera orbited(settings::Camera camera, double angle_rad) {
    const glm::dvec3 target = camera.target_world();
    const glm::dmat3 turn =
        glm::mat3_cast(glm::angleAxis(angle_rad, glm::dvec3(camera.world_from_view[1])));
    camera.eye_world = target + turn * (camera.eye_world - target);
    camera.world_from_view = turn * camera.world_from_view;
    return camera;
}

Error brokenOff() {
    return {ErrorCode::kCapacity, "the cost of a frame was not measured completely"};
}

// Frames of as many views in turn as keep the device busy, as those of several viewers come.
class Series {
  public:
    Series(std::vector<std::unique_ptr<ViewSource>>& views, const settings::ViewSettings& settings)
        : views_(views), settings_(settings) {}

    // Until a frame is done, and when that was.
    Result<TimePoint> next(const std::function<bool()>& goes_on) {
        for (;;) {
            if (!goes_on()) {
                return brokenOff();
            }
            if (auto given = give(); !given) {
                return given.error();
            } else if (*given) {
                continue;
            }
            const size_t view = on_device_.front();
            const auto collected = views_[view]->collect();
            on_device_.pop_front();
            const bool ended = !collected || collected->outcome == Collected::Outcome::kAgain;
            if (ended && view == turn_) {
                waiting_ = 0;
            }
            if (!collected) {
                return collected.error();
            }
            if (collected->outcome == Collected::Outcome::kFrame) {
                return Clock::now();
            }
        }
    }
    // The device has nothing of the views when this returns.
    Result<void> finish() {
        if (std::exchange(waiting_, 0) > 0) {
            views_[turn_]->abandon();
        }
        for (; !on_device_.empty(); on_device_.pop_front()) {
            const auto collected = views_[on_device_.front()]->collect();
            if (!collected && collected.error().code == ErrorCode::kDevice) {
                return collected.error();
            }
        }
        return {};
    }

  private:
    // Whether there was something to begin or to hand over.
    Result<bool> give() {
        if (on_device_.size() >= views_.size()) {
            return false;
        }
        if (waiting_ == 0) {
            const size_t turn = begun_ % views_.size();
            if (!views_[turn]->canBegin()) {
                return false;
            }
            const auto work = views_[turn]->begin(moving(), {},
                                                  {.encoding = {.becomes = settings::Encoding()},
                                                   .limit_share = scale_.limitShare()});
            if (!work && work.error().code == ErrorCode::kTooLong &&
                scale_.onTooLong(work.error().too_large_by, true)) {
                return true;
            }
            if (!work) {
                return work.error();
            }
            if (!work->half_built && work->piece_count == 0) {
                return brokenOff(); // its shaders are being made
            }
            turn_ = turn;
            waiting_ = work->half_built ? 0 : work->piece_count;
            begun_ += work->half_built ? 0U : 1U;
            return true;
        }
        if (const auto submitted = views_[turn_]->submitPiece(); !submitted) {
            return submitted.error();
        }
        --waiting_;
        on_device_.push_back(turn_);
        return true;
    }

    // As the frame begun next has them.
    [[nodiscard]] settings::ViewSettings moving() const {
        constexpr uint32_t kPlaces = 16;
        constexpr double kStep_rad = 0.01;
        settings::ViewSettings settings = session::scaled(settings_, scale_.scale());
        const auto place = static_cast<double>(begun_ / views_.size() % kPlaces);
        settings.camera = orbited(settings.camera, place * kStep_rad);
        return settings;
    }

    std::vector<std::unique_ptr<ViewSource>>& views_;
    const settings::ViewSettings& settings_;
    session::AffordableScale scale_;
    size_t begun_ = 0;             // frames
    size_t turn_ = 0;              // the view whose frame was begun last
    uint32_t waiting_ = 0;         // pieces of that frame
    std::deque<size_t> on_device_; // the view of each piece, oldest first
};

// The usual time from one frame to the next, of frames that take kWindow.
Result<Seconds> usualOf(Series& series, TimePoint& before, const std::function<bool()>& goes_on) {
    const TimePoint begin = before;
    std::vector<Seconds> intervals;
    while (intervals.size() < kFewest || before - begin < kWindow) {
        const auto done = series.next(goes_on);
        if (!done) {
            return done.error();
        }
        intervals.push_back(*done - std::exchange(before, *done));
    }
    const auto median = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), median, intervals.end());
    return *median;
}

// Until it gets no shorter: it was longer before the device's clocks and its pipelines were there.
Result<Seconds> measure(Series& series, Seconds warm_up, const std::function<bool()>& goes_on) {
    const auto first = series.next(goes_on);
    if (!first) {
        return first.error();
    }
    TimePoint before = *first;
    auto cost = usualOf(series, before, goes_on);
    while (cost && before - *first < kLongest) {
        const auto next = usualOf(series, before, goes_on);
        if (!next) {
            return next.error();
        }
        const bool steady = std::exchange(*cost, std::min(*cost, *next)) * kSteady < *next;
        if (steady && before - *first >= warm_up) {
            break;
        }
    }
    return cost;
}

} // namespace

Result<Seconds> measureFrameCost(FrameSource& source,
                                 const settings::ViewSettings& settings,
                                 const std::function<bool()>& goes_on) {
    std::vector<std::unique_ptr<ViewSource>> views;
    while (views.size() < source.depth()) {
        auto view = source.makeView();
        if (!view) {
            return view.error();
        }
        views.push_back(std::move(*view));
    }
    Series series(views, settings);
    auto cost = measure(series, source.isHost() ? Seconds(0) : kWarmUp, goes_on);
    if (cost || cost.error().code != ErrorCode::kDevice) {
        if (const auto finished = series.finish(); !finished) {
            cost = finished.error();
        }
    }
    if (!cost && cost.error().code == ErrorCode::kDevice) {
        for (auto& view : views) {
            keepForGood(std::move(view));
        }
    }
    return cost;
}

} // namespace froxel::stream
