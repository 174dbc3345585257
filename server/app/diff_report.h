// What `froxel diff` tells of its pairs of pictures. Pure functions.
#pragma once

#include "app/diff_command.h"
#include "app/junit.h"
#include "diff/difference.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace froxel::app {

struct DiffPair {
    std::string name; // the path below the folders, or the file's name
    std::optional<diff::Difference> difference;
    std::vector<std::string> faults; // broken limits, or why there is no difference

    [[nodiscard]] bool failed() const { return !faults.empty(); }
};

// A line for each pair, and one of the sum.
[[nodiscard]] std::string diffTable(const std::vector<DiffPair>& pairs);

[[nodiscard]] nlohmann::ordered_json diffReport(const DiffOptions& options,
                                                const std::vector<DiffPair>& pairs);

[[nodiscard]] std::vector<JunitCase> casesOf(const std::vector<DiffPair>& pairs);

// The pairs whose pictures a report shows: failed ones first, then by FLIP, the largest first; none
// of equal pictures. At most `count` indices.
[[nodiscard]] std::vector<size_t> worstOf(const std::vector<DiffPair>& pairs, size_t count);

} // namespace froxel::app
