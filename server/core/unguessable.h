// Names that nobody guesses.
#pragma once

#include <cerrno>
#include <cstddef>
#include <string>
#include <string_view>
#include <sys/random.h>
#include <system_error>

namespace froxel {

// So many bytes (at most 256) from the kernel's generator (getrandom), as hexadecimal digits.
// Throws std::system_error where the kernel has none.
[[nodiscard]] inline std::string unguessable(size_t byte_count) {
    std::string bytes(byte_count, '\0');
    // Up to 256 bytes come whole, or not at all.
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw std::system_error(errno, std::generic_category(), "getrandom");
    }
    constexpr std::string_view kHex = "0123456789abcdef";
    std::string digits;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        digits += kHex[byte >> 4U];
        digits += kHex[byte & 0xFU];
    }
    return digits;
}

// In a time that depends on the lengths alone, so that a guess cannot be bettered by its timing.
[[nodiscard]] inline bool sameSecret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) {
        return false;
    }
    volatile unsigned difference = 0; // volatile: no early end
    for (size_t i = 0; i < a.size(); ++i) {
        difference = difference | static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^
                                                        static_cast<unsigned char>(b[i]));
    }
    return difference == 0;
}

} // namespace froxel
