#include "load/frame_ages.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace froxel::load {
namespace {

// A slower clock tells no milliseconds, and a later one has none: both are numbers from outside.
constexpr double kLeastRate = 1e-3;
constexpr double kLatestS = 1e9;

} // namespace

double stagesMs(const v1::FrameHeader& header) {
    const uint64_t time_us = uint64_t{header.render_us()} + header.encode_wait_us() +
                             header.encode_us() + header.send_wait_us();
    return static_cast<double>(time_us) / 1000;
}

void FrameAges::onFrame(const v1::FrameHeader& header,
                        TimePoint now,
                        std::optional<double> age_ms) {
    Drawn drawn{stagesMs(header), std::nullopt, age_ms};
    if (clock_rate_ >= kLeastRate && std::abs(header.time_s()) <= kLatestS) {
        const std::chrono::duration<double, std::milli> here = now.time_since_epoch();
        drawn.clock_ms = here.count() - header.time_s() * 1000 / clock_rate_;
    }
    frames_.push_back(drawn);
}

std::optional<double> FrameAges::clockOffset() const {
    std::optional<double> by_commands;
    std::optional<double> by_stages;
    for (const Drawn& frame : frames_) {
        if (!frame.clock_ms) {
            continue;
        }
        const double least = frame.stages_ms - *frame.clock_ms;
        by_stages = by_stages ? std::max(*by_stages, least) : least;
        if (frame.age_ms) {
            const double told = *frame.age_ms - *frame.clock_ms;
            by_commands = by_commands ? std::min(*by_commands, told) : told;
        }
    }
    return by_commands ? by_commands : by_stages;
}

std::vector<double> FrameAges::all() const {
    const auto offset = clockOffset();
    std::vector<double> ages_ms;
    ages_ms.reserve(frames_.size());
    for (const Drawn& frame : frames_) {
        double age_ms = frame.stages_ms;
        if (frame.age_ms) {
            age_ms = *frame.age_ms;
        } else if (offset && frame.clock_ms) {
            age_ms = std::max(age_ms, *frame.clock_ms + *offset);
        }
        ages_ms.push_back(age_ms);
    }
    return ages_ms;
}

} // namespace froxel::load
