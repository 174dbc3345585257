// The fitted table, as interface/area_io.h describes it: GGX, then Blinn-Phong.
#pragma once

#include <span>

namespace froxel::area_light_table {

// Made at build time by make_table.cpp.
[[nodiscard]] std::span<const float> table();

} // namespace froxel::area_light_table
