#include "app/suggestion.h"

#include <algorithm>
#include <vector>

namespace froxel::app {
namespace {

size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> changes(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) {
        for (size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                changes[i][j] = i + j;
                continue;
            }
            const size_t other = a[i - 1] == b[j - 1] ? 0 : 1;
            changes[i][j] = std::min(
                {changes[i - 1][j] + 1, changes[i][j - 1] + 1, changes[i - 1][j - 1] + other});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                changes[i][j] = std::min(changes[i][j], changes[i - 2][j - 2] + 1);
            }
        }
    }
    return changes[a.size()][b.size()];
}

} // namespace

std::string nearestOf(std::string_view given, std::span<const std::string> names) {
    constexpr size_t kLongest = 64; // no name is longer
    std::string nearest;
    size_t fewest = given.size() / 3 + 1;
    if (given.size() > kLongest) {
        return nearest;
    }
    for (const std::string& name : names) {
        if (const size_t changes = distance(given, name); changes < fewest) {
            fewest = changes;
            nearest = name;
        }
    }
    return nearest;
}

} // namespace froxel::app
