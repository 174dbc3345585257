#include "session/resume_token.h"

#include "core/unguessable.h"

namespace froxel::session {

std::string makeResumeToken() {
    constexpr size_t kBytes = 32;
    return unguessable(kBytes);
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
