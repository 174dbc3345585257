#include "stream/frame_cost.h"

#include "core/keep_for_good.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace froxel::stream {
namespace {

// Long enough for a GPU that was idle to come to its clocks; a slower device ends by the count.
constexpr Seconds kLongest{0.25};
constexpr uint32_t kFewest = 2; // intervals between frames

Error brokenOff() {
    return {ErrorCode::kCapacity, "what a frame costs was not measured to the end"};
}

// Frames of one view, one after another, as many under way as keep the device busy.
class Series {
  public:
    Series(ViewSource& view, const settings::ViewSettings& settings, uint32_t depth)
        : view_(view), settings_(settings), depth_(depth) {}

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
            const auto collected = view_.collect();
            --on_device_;
            if (!collected) {
                waiting_ = 0;
                return collected.error();
            }
            if (collected->outcome == Collected::Outcome::kFrame) {
                return Clock::now();
            }
            if (collected->outcome == Collected::Outcome::kAgain) {
                waiting_ = 0;
            }
        }
    }
    // The device has nothing of the view when this returns.
    Result<void> finish() {
        if (std::exchange(waiting_, 0) > 0) {
            view_.abandon();
        }
        while (on_device_ > 0) {
            const auto collected = view_.collect();
            if (!collected && collected.error().code == ErrorCode::kDevice) {
                return collected.error();
            }
            --on_device_;
        }
        return {};
    }

  private:
    // Whether there was something to begin or to hand over.
    Result<bool> give() {
        if (on_device_ >= depth_) {
            return false;
        }
        if (waiting_ == 0) {
            if (!view_.canBegin()) {
                return false;
            }
            const auto work = view_.begin(settings_, {}, 0);
            if (!work) {
                return work.error();
            }
            if (!work->half_built && work->piece_count == 0) {
                return brokenOff(); // its shaders are being made
            }
            waiting_ = work->half_built ? 0 : work->piece_count;
            return true;
        }
        if (const auto submitted = view_.submitPiece(); !submitted) {
            return submitted.error();
        }
        --waiting_;
        ++on_device_;
        return true;
    }

    ViewSource& view_;
    const settings::ViewSettings& settings_;
    const uint32_t depth_;
    uint32_t waiting_ = 0;   // pieces of the frame begun last
    uint32_t on_device_ = 0; // pieces
};

// The usual time from one frame to the next in the latter half of the series: it was slower before
// its pipelines and the device's clocks were there.
Result<Seconds> measure(Series& series, const std::function<bool()>& goes_on) {
    const auto first = series.next(goes_on);
    if (!first) {
        return first.error();
    }
    TimePoint before = *first;
    std::vector<Seconds> intervals;
    while (intervals.size() < kFewest || before - *first < kLongest) {
        const auto done = series.next(goes_on);
        if (!done) {
            return done.error();
        }
        intervals.push_back(*done - std::exchange(before, *done));
    }
    const auto half = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    const auto median = half + (intervals.end() - half) / 2;
    std::nth_element(half, median, intervals.end());
    return *median;
}

} // namespace

Result<Seconds> measureFrameCost(FrameSource& source,
                                 const settings::ViewSettings& settings,
                                 const std::function<bool()>& goes_on) {
    auto view = source.makeView();
    if (!view) {
        return view.error();
    }
    Series series(**view, settings, source.depth());
    auto cost = measure(series, goes_on);
    if (cost || cost.error().code != ErrorCode::kDevice) {
        if (const auto finished = series.finish(); !finished) {
            cost = finished.error();
        }
    }
    if (!cost && cost.error().code == ErrorCode::kDevice) {
        keepForGood(std::move(*view));
    }
    return cost;
}

} // namespace froxel::stream
