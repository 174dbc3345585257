// Two results of `froxel bench`, row by row. Pure.
#pragma once

#include "core/error.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace froxel::bench {

// Frames beyond the noise by report::compareSamples. The time compared is gpu_us on a GPU and
// cpu_us on a CPU device, whose wall time also measures its neighbours.
struct RowComparison {
    std::string row; // "light_count: naive, 100 lights"
    double median_a_us = 0;
    double median_b_us = 0;
    std::string words;
    bool slower = false; // b, beyond the noise
    bool faster = false;
    std::string error; // how an error changed, else empty
    bool error_grew = false;
};

struct Comparison {
    std::string measure;               // "gpu_us" or "cpu_us"
    std::vector<std::string> warnings; // what makes the two hard to compare
    std::vector<RowComparison> rows;
    std::vector<std::string> only_a;
    std::vector<std::string> only_b;

    [[nodiscard]] bool worse() const;
};

// Rows match by sweep, series, label, scaled_to, stream and settings, but for those at their
// defaults that only one result tells. Errors: kInvalidArgument where one is not a result of this
// schema.
[[nodiscard]] Result<Comparison> compareReports(const nlohmann::ordered_json& a,
                                                const nlohmann::ordered_json& b);

// A table for a terminal.
[[nodiscard]] std::string toText(const Comparison& comparison);

} // namespace froxel::bench
