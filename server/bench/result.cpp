#include "bench/result.h"

#include <spdlog/fmt/fmt.h>

namespace froxel::bench {

std::vector<std::string> inexactRows(const RunResult& result) {
    std::vector<std::string> lines;
    for (const auto& found : result.sweeps) {
        for (size_t i = 0; i < found.rows.size(); ++i) {
            const auto& row = found.sweep.rows[i];
            const auto& error = found.rows[i].errors.r1;
            const bool capped = row.settings.list_cap > 0; // inexact on purpose
            if (!found.rows[i].times.measured() || !error.skipped.empty() || error.exact() ||
                capped) {
                continue;
            }
            lines.push_back(fmt::format(
                "{}: {}, {}: differs from every light in the same way in {} pixels of {}, by up to "
                "{:.3g}, at view '{}'",
                found.sweep.name, row.series, row.label,
                error.linear.differing_count + error.linear.nonfinite_count,
                error.linear.pixel_count, error.linear.max_abs,
                result.base.views[error.view].name));
        }
    }
    return lines;
}

} // namespace froxel::bench
