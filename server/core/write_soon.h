// A few words to a terminal, a pipe or a file, which whoever reads there cannot hold up.
#pragma once

#include <poll.h>
#include <string_view>
#include <unistd.h>

namespace froxel {

// Whether `text`, of at most PIPE_BUF bytes (4096), went to the descriptor within a second: a pipe
// that has room takes as many without waiting (pipe(7)).
inline bool writeSoon(int descriptor, std::string_view text) {
    constexpr int kPatience_ms = 1000;
    pollfd room{.fd = descriptor, .events = POLLOUT, .revents = 0};
    return ::poll(&room, 1, kPatience_ms) == 1 &&
           ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

} // namespace froxel
