// Words of a file that stand for one of a few things.
#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>

namespace froxel::gltf {

// The second of the row whose first is `word`; none: the table has no such row.
template <class Table>
[[nodiscard]] auto named(const Table& table, std::string_view word) {
    const auto found = std::find_if(std::begin(table), std::end(table),
                                    [&](const auto& row) { return row.first == word; });
    return found == std::end(table) ? std::nullopt : std::optional(found->second);
}

} // namespace froxel::gltf
