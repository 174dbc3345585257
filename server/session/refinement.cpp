#include "session/refinement.h"

namespace froxel::session {
namespace {

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

void RefinementSchedule::onChange(TimePoint now) {
    changed_at_ = now;
}

void RefinementSchedule::onBegun(Refinement stage, bool limited) {
    shown_ = stage;
    limited_ = limited;
}

void RefinementSchedule::onLost() {
    shown_ = Refinement::kInteractive;
    limited_ = true;
}

std::optional<RefinementSchedule::Due> RefinementSchedule::next(settings::Refine wanted,
                                                                const Delivery& delivery,
                                                                settings::Size size) const {
    const bool high = wanted != settings::Refine::kNone && fits(delivery, size, kHighBits);
    if (high && shown_ < Refinement::kHigh) {
        return Due{Refinement::kHigh, after(changed_at_, kSettleAfter)};
    }
    if (limited_ && shown_ == Refinement::kInteractive) {
        return Due{Refinement::kSettled, after(changed_at_, kSettleAfter)};
    }
    if (wanted == settings::Refine::kLossless && shown_ < Refinement::kLossless &&
        fits(delivery, size, kLosslessBits)) {
        return Due{Refinement::kLossless, after(changed_at_, kLosslessAfter)};
    }
    return {};
}

} // namespace froxel::session
