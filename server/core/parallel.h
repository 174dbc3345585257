// Loops that are long now and then, on as many threads as pay.
#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace froxel {

// How many threads pay for so many things, of which each should have `least_each`. At least 1, at
// most as many as the machine has.
[[nodiscard]] inline size_t threadCount(size_t count, size_t least_each) {
    return std::clamp<size_t>(count / least_each, 1,
                              std::max(1U, std::thread::hardware_concurrency()));
}

// Cuts [0, count) into as many ranges as there are threads, calls job(thread, begin, end) once for
// each, the first on the caller's thread, and returns when all are done. What a job throws is
// thrown.
template <class Job>
void onThreads(size_t count, size_t threads, const Job& job) {
    std::vector<std::future<void>> others;
    for (size_t thread = 1; thread < threads; ++thread) {
        others.push_back(std::async(std::launch::async, [&job, count, threads, thread] {
            job(thread, count * thread / threads, count * (thread + 1) / threads);
        }));
    }
    job(0, 0, count / threads);
    for (auto& other : others) {
        other.get();
    }
}

} // namespace froxel
