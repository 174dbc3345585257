// Numbers, and lists separated by commas, from texts that hold nothing else.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace froxel::load {

// None where the text is no number of this type, or more than one.
template <class T>
[[nodiscard]] std::optional<T> numberFrom(std::string_view text) {
    T value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool all = failure == std::errc() && end == text.data() + text.size();
    return all ? std::optional(value) : std::nullopt;
}

// At least one part; parts may be empty.
[[nodiscard]] inline std::vector<std::string_view> partsOf(std::string_view text) {
    std::vector<std::string_view> parts;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(',', begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

} // namespace froxel::load
