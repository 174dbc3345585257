// How many frames of a row the time allows, and in which order rows take turns. Pure.
#pragma once

#include "settings/settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace froxel::bench {

struct Budget {
    double seconds_per_row = 10; // for warm-up and frames of one row
    uint32_t frames_wanted = 200;
    uint32_t frames_least = 8; // fewer say nothing about noise: the row is left out
    uint32_t rounds = 4;
    uint32_t warmup_frames = 3; // before each turn
    uint32_t warmup_first = 30; // before a row's first turn, as far as a quarter of its time allows
};

// Of warmup_first, whatever they take: the first frame compiles, and the second may, by what the
// first has learnt of the scene's overlap.
inline constexpr uint32_t kProbeFrames = 3;

// A CPU device's frames are slow and it has no clocks to wait for.
[[nodiscard]] Budget budgetFor(bool device_is_cpu, double seconds_per_row);

// What is known of an earlier row of the same series.
struct KnownFrame {
    double frame_s = 0;
    double work = 0; // workOf() its settings
};

// In light evaluations of a pixel, as if every light reached every pixel; a pixel without lights
// costs about as much as 16.
[[nodiscard]] double workOf(const settings::ViewSettings& settings);

// Why a row is not worth a first frame: by the row before, kProbeFrames alone may take longer than
// its time. Work is an upper bound, so a row that would have fitted may be left out; one of no more
// work than the row before never is.
[[nodiscard]] std::optional<std::string>
refusalByPrediction(const std::optional<KnownFrame>& before, double work, const Budget& budget);

struct RowFrames {
    uint32_t count = 0; // 0: too few would fit
    std::string remark; // why none or fewer than wanted, else empty
};

// From what one frame takes, after warm-up.
[[nodiscard]] RowFrames framesThatFit(double frame_s, const Budget& budget);

struct Turn {
    size_t row = 0;
    uint32_t first_frame = 0;
    uint32_t frame_count = 0;
};

// Rounds of all rows in order, each row's frames spread evenly: A B A B. Rows without frames have
// no turns.
[[nodiscard]] std::vector<Turn> interleaved(std::span<const uint32_t> frame_counts,
                                            uint32_t rounds);

} // namespace froxel::bench
