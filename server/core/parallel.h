// Loops that are long now and then, on as many threads as pay.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace froxel {

// How many threads pay for so many things, of which each should have `least_each`. At least 1, at
// most as many as the machine has, or 16: they are started one after another.
[[nodiscard]] inline size_t threadCount(size_t count, size_t least_each) {
    // Asked once: it reads a file of the system.
    static const size_t most = std::clamp(std::thread::hardware_concurrency(), 1U, 16U);
    return std::clamp<size_t>(count / least_each, 1, most);
}

// Cuts [0, count) into as many ranges as there are threads, calls job(thread, begin, end) once for
// each, the first on the caller's thread, as others are for which the system gives no thread, and
// returns when all are done. What a job throws is thrown.
template <class Job>
void onThreads(size_t count, size_t threads, const Job& job) {
    const auto run = [&job, count, threads](size_t thread) {
        job(thread, count * thread / threads, count * (thread + 1) / threads);
    };
    std::vector<std::future<void>> others;
    size_t left = threads; // from here on
    for (size_t thread = 1; thread < left; ++thread) {
        try {
            others.push_back(std::async(std::launch::async, run, thread));
        } catch (const std::system_error&) {
            left = thread;
        }
    }
    run(0);
    for (size_t thread = left; thread < threads; ++thread) {
        run(thread);
    }
    for (auto& other : others) {
        other.get();
    }
}

// Calls job(i) for each i below `count`, in any order, on so many threads: whoever is done takes
// the next. Otherwise as onThreads().
template <class Job>
void eachOnThreads(size_t count, size_t threads, const Job& job) {
    std::atomic<size_t> next{0};
    onThreads(threads, threads, [&](size_t /*thread*/, size_t /*begin*/, size_t /*end*/) {
        for (size_t i = next++; i < count; i = next++) {
            job(i);
        }
    });
}

} // namespace froxel
