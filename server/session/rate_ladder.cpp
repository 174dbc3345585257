#include "session/rate_ladder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::session {
namespace {

constexpr std::array kQualities = {90U, 75U, 65U, 55U, 45U};
constexpr std::array kScales = {0.75, 0.5};
// Of a video's rate: first at full size, since another size begins the stream anew by a key frame.
constexpr std::array kShares = {0.7, 0.5, 0.35};
constexpr std::array kShareAtScales = {0.25, 0.15};
constexpr std::array kShareAtIntervals = {0.1, 0.06};
constexpr std::array kIntervals = {Seconds(0.1), Seconds(0.2)};

// libjpeg's scale of its quantisation tables, in percent.
double tableScale(uint32_t quality) {
    return quality < 50 ? 5000.0 / quality : std::max(2.0, 200.0 - 2.0 * quality);
}

// Bits of a frame up to a factor. The built-in hall at 640x360 and 1280x720, against quality 75
// with 4:2:0: quality 45 has 0.60, 55 0.69, 65 0.82, 85 1.37, 90 1.74; 4:4:4 1.37.
double bitsOf(const settings::Encoding& encoding, double scale) {
    const double chroma = encoding.chroma == settings::Chroma::k444 ? 1.37 : 1.0;
    return chroma * std::pow(tableScale(encoding.quality), -0.65) * std::pow(scale, 1.6);
}

class Builder {
  public:
    explicit Builder(const settings::Encoding& asked) : asked_(asked) { add(); }

    void add() {
        next_.rung = static_cast<uint32_t>(ladder_.size());
        const double bits = by_rate_
                                ? videoBits()
                                : bitsOf(limited(asked_, next_), next_.scale) / bitsOf(asked_, 1);
        ladder_.push_back({next_, bits, alone_});
    }
    std::vector<Rung> build() {
        by_rate_ ? addShares() : addQualities();
        for (size_t i = 0; i < kScales.size(); ++i) {
            next_.scale = kScales[i];
            next_.video_share = by_rate_ ? kShareAtScales[i] : 1;
            add();
        }
        alone_ = true;
        add();
        for (size_t i = 0; i < kIntervals.size(); ++i) {
            next_.min_interval = kIntervals[i];
            next_.video_share = by_rate_ ? kShareAtIntervals[i] : 1;
            add();
        }
        return std::move(ladder_);
    }

  private:
    void addQualities() {
        for (const uint32_t quality : kQualities) {
            next_.quality_max = quality;
            if (quality < asked_.quality) {
                add();
            }
        }
        next_.chroma_max = settings::Chroma::k420;
        if (asked_.chroma != settings::Chroma::k420) {
            add();
        }
    }
    // Fewer frames of a video have more bits each.
    [[nodiscard]] double videoBits() const {
        constexpr double kUsualFps = 30;
        return next_.video_share * std::max(1.0, next_.min_interval.count() * kUsualFps);
    }
    void addShares() {
        for (const double share : kShares) {
            next_.video_share = share;
            add();
        }
    }

    const settings::Encoding asked_;
    const bool by_rate_ =
        settings::rowOf(asked_.codec).rate_control == settings::RateControl::kBitrate;
    Delivery next_;
    bool alone_ = false;
    std::vector<Rung> ladder_;
};

} // namespace

std::vector<Rung> makeLadder(const settings::Encoding& asked) {
    return Builder(asked).build();
}

} // namespace froxel::session
