#include "bench/budget.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace froxel::bench {

namespace {

std::string secondsText(double seconds) {
    return fmt::format("{:.3g} s", seconds);
}

} // namespace

Budget budgetFor(bool device_is_cpu, double seconds_per_row) {
    Budget budget;
    budget.seconds_per_row = seconds_per_row;
    if (device_is_cpu) {
        budget.frames_wanted = 100;
        budget.warmup_frames = 1;
        budget.warmup_first = 5;
    }
    return budget;
}

double workOf(const settings::ViewSettings& settings) {
    constexpr double kPixel = 16;
    const double pixels = static_cast<double>(settings.size.width_px) * settings.size.height_px;
    return pixels * (kPixel + settings.lights.count);
}

std::optional<std::string>
refusalByPrediction(const std::optional<KnownFrame>& before, double work, const Budget& budget) {
    if (!before || work <= before->work) {
        return std::nullopt;
    }
    const double probe_s = kProbeFrames * before->frame_s * work / before->work;
    if (probe_s <= budget.seconds_per_row) {
        return std::nullopt;
    }
    return fmt::format("{} frames to try it may take {} by the series' row before; a row's time is "
                       "{}",
                       kProbeFrames, secondsText(probe_s), secondsText(budget.seconds_per_row));
}

RowFrames framesThatFit(double frame_s, const Budget& budget) {
    const double warmup = budget.rounds * budget.warmup_frames;
    const double fit = std::floor(budget.seconds_per_row / frame_s - warmup);
    if (fit < budget.frames_least) {
        return {0, fmt::format("a frame takes {}, so fewer than {} fit a row's time of {}",
                               secondsText(frame_s), budget.frames_least,
                               secondsText(budget.seconds_per_row))};
    }
    if (fit >= budget.frames_wanted) {
        return {budget.frames_wanted, {}};
    }
    return {static_cast<uint32_t>(fit),
            fmt::format("as many frames as fit {}; {} were wanted",
                        secondsText(budget.seconds_per_row), budget.frames_wanted)};
}

std::vector<Turn> interleaved(std::span<const uint32_t> frame_counts, uint32_t rounds) {
    std::vector<Turn> turns;
    for (uint32_t round = 0; round < rounds; ++round) {
        for (size_t row = 0; row < frame_counts.size(); ++row) {
            const uint64_t count = frame_counts[row];
            const auto first = static_cast<uint32_t>(count * round / rounds);
            const auto end = static_cast<uint32_t>(count * (round + 1) / rounds);
            if (end > first) {
                turns.push_back({row, first, end - first});
            }
        }
    }
    return turns;
}

} // namespace froxel::bench
