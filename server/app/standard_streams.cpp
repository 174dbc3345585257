#include "app/standard_streams.h"

#include "core/error.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <string>
#include <system_error>
#include <unistd.h>

namespace froxel::app {

void holdStandardStreams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
            ::open("/dev/null", O_RDWR); // the lowest that is free, which is this one
        }
    }
    std::signal(SIGPIPE, SIG_IGN);
}

void finishResults() {
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        const std::string reason =
            errno != 0 ? ": " + std::generic_category().message(errno) : std::string();
        throw StartupError(
            {ErrorCode::kIo, "standard output did not accept the whole result" + reason});
    }
}

} // namespace froxel::app
