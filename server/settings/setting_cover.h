// For static_assert: whether a table has a row for each member of a struct.
#pragma once

#include "settings/setting.h"

#include <boost/pfr/tuple_size.hpp>

#include <algorithm>
#include <cstddef>

namespace froxel::settings {

// So many members have no row, since they are by hand.
template <class Struct, class Rows>
constexpr bool covers(const Rows& rows, size_t by_hand) {
    const auto held = std::count_if(rows.begin(), rows.end(), [](const auto& row) {
        return row.member_of == membersOf<Struct>();
    });
    return static_cast<size_t>(held) + by_hand == boost::pfr::tuple_size_v<Struct>;
}

} // namespace froxel::settings
