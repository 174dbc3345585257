// Text for one-line messages.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace froxel {

// Shortest text that reads back as the same number, written out from a millionth to 1e15:
// "0.0001", "10000000", "1e-07", "nan".
template <class T>
[[nodiscard]] std::string numberText(T value) {
    static_assert(std::is_arithmetic_v<T>);
    char digits[32];
    if constexpr (std::is_floating_point_v<T>) {
        const T size = std::abs(value);
        if (value == 0 || (size >= T(1e-6) && size < T(1e15))) {
            const auto format = std::chars_format::fixed;
            return {digits, std::to_chars(digits, digits + sizeof digits, value, format).ptr};
        }
    }
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

// Outside text made safe for a log line or an error: printable ASCII stays, every other byte
// becomes \xNN, and what is beyond `max_bytes` of the input becomes "...".
[[nodiscard]] inline std::string printable(std::string_view untrusted, size_t max_bytes = 80) {
    constexpr std::string_view kHex = "0123456789abcdef";
    std::string text;
    for (const char character : untrusted.substr(0, max_bytes)) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte >= 0x20 && byte < 0x7F) {
            text += character;
        } else {
            text += "\\x";
            text += kHex[byte >> 4U];
            text += kHex[byte & 0xFU];
        }
    }
    return untrusted.size() > max_bytes ? text + "..." : text;
}

// A value of a `key=value` log line: outside text made safe as by printable(), in double quotes
// where it is more than one plain word.
[[nodiscard]] inline std::string logValue(std::string_view untrusted, size_t max_bytes = 200) {
    const std::string text = printable(untrusted, max_bytes);
    if (!text.empty() && text.find_first_of(" \"=\\") == std::string::npos) {
        return text;
    }
    std::string out = "\"";
    for (const char character : text) {
        if (character == '"' || character == '\\') {
            out += '\\';
        }
        out += character;
    }
    return out + '"';
}

} // namespace froxel
