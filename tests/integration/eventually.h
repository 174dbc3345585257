// Waits for a condition instead of sleeping.
#pragma once

#include <chrono>
#include <thread>

namespace froxel::test {

// Whether the condition came to hold within the limit.
template <class Condition>
bool eventually(const Condition& condition,
                std::chrono::steady_clock::duration limit = std::chrono::seconds(20)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) {
            return false;
        }
        std::this_thread::yield();
    }
    return true;
}

} // namespace froxel::test
