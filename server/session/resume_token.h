// The secret by which a viewer takes up its session again after its connection was lost.
#pragma once

#include <string>
#include <string_view>

namespace froxel::session {

// 256 bits from the kernel's generator (getrandom) as 64 hexadecimal digits. Throws
// std::system_error where the kernel has none. Never to be logged.
[[nodiscard]] std::string makeResumeToken();

// Its public part, by which a client says before Hello which session it comes back to. Tells
// nothing of the rest, which still has 192 bits.
[[nodiscard]] std::string_view resumeName(std::string_view token);

} // namespace froxel::session
