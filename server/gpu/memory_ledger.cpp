#include "gpu/memory_ledger.h"

#include "core/assert.h"

namespace froxel::gpu {

void MemoryLedger::add(std::string_view purpose, uint64_t bytes) {
    const std::scoped_lock lock(mutex_);
    const auto found = bytes_.find(purpose);
    if (found != bytes_.end()) {
        found->second += bytes;
    } else {
        bytes_.emplace(purpose, bytes);
    }
    ++version_;
}

void MemoryLedger::remove(std::string_view purpose, uint64_t bytes) {
    const std::scoped_lock lock(mutex_);
    const auto found = bytes_.find(purpose);
    FROXEL_ASSERT(found != bytes_.end() && found->second >= bytes,
                  "only what was allocated is freed");
    found->second -= bytes;
    if (found->second == 0) {
        bytes_.erase(found);
    }
    ++version_;
}

std::map<std::string, uint64_t> MemoryLedger::byPurpose() const {
    const std::scoped_lock lock(mutex_);
    return {bytes_.begin(), bytes_.end()};
}

uint64_t MemoryLedger::totalBytes() const {
    const std::scoped_lock lock(mutex_);
    uint64_t total = 0;
    for (const auto& [purpose, bytes] : bytes_) {
        total += bytes;
    }
    return total;
}

uint64_t MemoryLedger::version() const {
    const std::scoped_lock lock(mutex_);
    return version_;
}

} // namespace froxel::gpu
