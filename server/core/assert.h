// A broken invariant is a bug: log and abort, in every build type.
#pragma once

#include <cstdio>
#include <cstdlib>

#define FROXEL_ASSERT(condition, message)                                                          \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            std::fprintf(stderr, "%s:%d: bug: %s (%s)\n", __FILE__, __LINE__, message,             \
                         #condition);                                                              \
            std::abort();                                                                          \
        }                                                                                          \
    } while (false)
