#include "session/rate_ladder.h"

#include <array>

namespace froxel::session {
namespace {

constexpr std::array kQualities = {90U, 75U, 65U, 55U, 45U};
constexpr std::array kScales = {0.75, 0.5};
constexpr std::array kIntervals = {Seconds(0.1), Seconds(0.2)};

// libjpeg's scale of its quantisation tables, in percent.
double tableScale(uint32_t quality) {
    return quality < 50 ? 5000.0 / quality : std::max(2.0, 200.0 - 2.0 * quality);
}

// Bits of a frame up to a factor. The built-in hall at 640x360 and 1280x720, against quality 75
// with 4:2:0: quality 45 has 0.60, 55 0.69, 65 0.82, 85 1.37, 90 1.74; 4:4:4 1.37.
double bitsOf(const view::Encoding& encoding, double scale) {
    const double chroma = encoding.chroma == view::Chroma::k444 ? 1.37 : 1.0;
    return chroma * std::pow(tableScale(encoding.quality), -0.65) * std::pow(scale, 1.6);
}

class Builder {
  public:
    explicit Builder(const view::Encoding& asked) : asked_(asked) { add(); }

    void add() {
        next_.rung = static_cast<uint32_t>(ladder_.size());
        const double all = bitsOf(asked_, 1);
        ladder_.push_back({next_, bitsOf(limited(asked_, next_), next_.scale) / all, alone_});
    }
    std::vector<Rung> build() {
        for (const uint32_t quality : kQualities) {
            next_.quality_max = quality;
            if (quality < asked_.quality) {
                add();
            }
        }
        next_.chroma_max = view::Chroma::k420;
        if (asked_.chroma != view::Chroma::k420) {
            add();
        }
        for (const double scale : kScales) {
            next_.scale = scale;
            add();
        }
        alone_ = true;
        add();
        for (const Seconds interval : kIntervals) {
            next_.min_interval = interval;
            add();
        }
        return std::move(ladder_);
    }

  private:
    const view::Encoding asked_;
    Delivery next_;
    bool alone_ = false;
    std::vector<Rung> ladder_;
};

} // namespace

std::vector<Rung> makeLadder(const view::Encoding& asked) {
    return Builder(asked).build();
}

} // namespace froxel::session
