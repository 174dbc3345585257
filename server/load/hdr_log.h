// Samples in HdrHistogram's log format, version 1.3 (https://github.com/HdrHistogram/HdrHistogram,
// class HistogramLogWriter): histograms of several machines and intervals add up without loss, by
// tools of many languages. Three significant digits; values are whole microseconds from 1 us to an
// hour. Pure.
#pragma once

#include "core/clock.h"

#include <string>
#include <string_view>
#include <vector>

namespace froxel::load {

// The lines before the first interval. `start_s`: since 1970.
[[nodiscard]] std::string hdrLogHeader(double start_s);

// One line; empty without a sample. `tag` parts the histograms of one log, such as "latency".
// `begin` counts from the start. Times below 1 us count as 1 us, and those above an hour as an
// hour.
[[nodiscard]] std::string hdrLogLine(std::string_view tag,
                                     Seconds begin,
                                     Seconds length,
                                     const std::vector<double>& samples_ms);

} // namespace froxel::load
