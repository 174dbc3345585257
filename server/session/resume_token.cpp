#include "session/resume_token.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <sys/random.h>
#include <system_error>

namespace froxel::session {

std::string makeResumeToken() {
    std::array<uint8_t, 32> bytes{};
    // Up to 256 bytes come whole, or not at all.
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw std::system_error(errno, std::generic_category(), "getrandom");
    }
    constexpr std::string_view kHex = "0123456789abcdef";
    std::string token;
    for (const uint8_t byte : bytes) {
        token += kHex[byte >> 4U];
        token += kHex[byte & 0xFU];
    }
    return token;
}

std::string_view resumeName(std::string_view token) {
    constexpr size_t kNameDigits = 16;
    return token.substr(0, kNameDigits);
}

bool sameToken(std::string_view a, std::string_view b) {
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

} // namespace froxel::session
