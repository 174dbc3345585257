// What threads have worked, as against the time that has passed.
#pragma once

#include "core/clock.h"

#include <ctime>

namespace froxel {

namespace detail {
[[nodiscard]] inline std::chrono::nanoseconds cpuTime(clockid_t whose) {
    timespec time{};
    clock_gettime(whose, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}
} // namespace detail

// Of the calling thread so far.
[[nodiscard]] inline std::chrono::nanoseconds threadTime() {
    return detail::cpuTime(CLOCK_THREAD_CPUTIME_ID);
}

// Of all threads of this process so far.
[[nodiscard]] inline std::chrono::nanoseconds processTime() {
    return detail::cpuTime(CLOCK_PROCESS_CPUTIME_ID);
}

} // namespace froxel
