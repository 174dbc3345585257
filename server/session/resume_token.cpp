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

} // namespace froxel::session
