#include "session/refinement.h"

#include "settings/debug_view.h"

#include <algorithm>

namespace froxel::session {
namespace {

// The host takes 5 ms to add a sample of so many, and 16 ms for their mean; other views wait.
constexpr uint64_t kMostPixels = uint64_t{2560} * 1440;

TimePoint after(TimePoint since, Seconds time) {
    return since + std::chrono::duration_cast<Clock::duration>(time);
}

bool fits(const Delivery& delivery, settings::Size size, double bits_per_pixel) {
    const double pixels = double{1} * size.width_px * size.height_px;
    return !delivery.link_rate ||
           pixels * bits_per_pixel <=
               *delivery.link_rate * RefinementSchedule::kMostOfTheLink.count();
}

} // namespace

uint32_t restingSamples(const settings::ViewSettings& settings) {
    const uint64_t pixels = uint64_t{settings.size.width_px} * settings.size.height_px;
    return pixels <= kMostPixels && settings.debug.view == settings::DebugView::kNone
               ? settings::kMeanSamples
               : 1;
}

void RefinementSchedule::onChange(TimePoint now) {
    changed_at_ = now;
    samples_refused_ = false;
}

void RefinementSchedule::onBegun(Refinement stage, bool limited) {
    begun_ = stage == shown_ ? begun_ + 1 : 1;
    shown_ = stage;
    limited_ = limited;
}

void RefinementSchedule::onSamplesLost() {
    shown_ = std::min(shown_, Refinement::kHigh);
}

void RefinementSchedule::onSamplesRefused() {
    samples_refused_ = true;
    onSamplesLost();
}

std::optional<RefinementSchedule::Due>
RefinementSchedule::next(settings::Refine wanted,
                         const Delivery& delivery,
                         const settings::ViewSettings& settings,
                         uint32_t most_samples) const {
    const settings::Size& size = settings.size;
    const uint32_t samples =
        samples_refused_ ? 1 : std::min(most_samples, restingSamples(settings));
    if (shown_ >= Refinement::kSmooth && begun_ < samples) {
        return Due{shown_, changed_at_, begun_, samples}; // what has begun goes on
    }
    const bool high = wanted != settings::Refine::kNone && fits(delivery, size, kHighBits);
    if (high && shown_ < Refinement::kHigh) {
        return Due{Refinement::kHigh, after(changed_at_, kSettleAfter)};
    }
    if (limited_ && shown_ == Refinement::kInteractive) {
        return Due{Refinement::kSettled, after(changed_at_, kSettleAfter)};
    }
    const TimePoint at = after(changed_at_, kSmoothAfter);
    if (wanted == settings::Refine::kLossless && shown_ < Refinement::kLossless &&
        fits(delivery, size, kLosslessBits)) {
        return Due{Refinement::kLossless, at, 0, samples};
    }
    if (high && samples > 1 && shown_ < Refinement::kSmooth) {
        return Due{Refinement::kSmooth, at, 0, samples};
    }
    return {};
}

} // namespace froxel::session
