// A broken invariant is a bug: say it and abort, in every build type.
#pragma once

#include "core/write_soon.h"

#include <cstdlib>
#include <string>
#include <unistd.h>

namespace froxel {

[[noreturn]] inline void
abortForBug(const char* file, int line, const char* message, const char* condition) {
    writeSoon(STDERR_FILENO, std::string(file) + ":" + std::to_string(line) + ": bug: " + message +
                                 " (" + condition + ")\n");
    std::abort();
}

} // namespace froxel

#define FROXEL_ASSERT(condition, message)                                                          \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            ::froxel::abortForBug(__FILE__, __LINE__, message, #condition);                        \
        }                                                                                          \
    } while (false)
