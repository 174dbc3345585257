// What top -H, perf and gdb call a thread; threads that a driver starts from it are called the
// same.
#pragma once

#include <pthread.h>

namespace froxel {

// Names the calling thread; at most 15 characters (pthread_setname_np(3)).
template <size_t kSize>
void nameThread(const char (&name)[kSize]) {
    static_assert(kSize <= 16, "the kernel keeps 15 characters");
    pthread_setname_np(pthread_self(), name);
}

} // namespace froxel
