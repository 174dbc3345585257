// For what must not be freed although nobody needs it: memory that a device which did not answer
// in time may yet write to.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace froxel {

// Until the process ends; reachable, so that nobody takes it for a leak. Any thread.
template <class T>
void keepForGood(std::unique_ptr<T> object) {
    static auto* const mutex = new std::mutex;
    static auto* const kept = new std::vector<std::unique_ptr<T>>;
    const std::lock_guard lock(*mutex);
    kept->push_back(std::move(object));
}

} // namespace froxel
