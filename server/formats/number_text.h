// Numbers in files of text.
#pragma once

#include <boost/spirit/home/x3.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace froxel::formats {

// Also "nan" and "inf", which the loader of glTF handles.
inline constexpr boost::spirit::x3::real_parser<double> kFloat{};

// Counted from 1.
[[nodiscard]] inline size_t lineOf(std::string_view text, size_t offset) {
    return 1 + static_cast<size_t>(std::ranges::count(text.substr(0, offset), '\n'));
}

} // namespace froxel::formats
