// Numbers from texts that hold nothing else.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace froxel::load {

// None where the text is no number of this type, or more than one.
template <class T>
[[nodiscard]] std::optional<T> numberFrom(std::string_view text) {
    T value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool all = failure == std::errc() && end == text.data() + text.size();
    return all ? std::optional(value) : std::nullopt;
}

} // namespace froxel::load
