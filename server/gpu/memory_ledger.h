// How much device memory is allocated for which purpose, over all arenas of a device. Any thread:
// a lease may end, and free its pixels, anywhere.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace froxel::gpu {

class MemoryLedger {
  public:
    void add(std::string_view purpose, uint64_t bytes);
    // Of what was added before for that purpose.
    void remove(std::string_view purpose, uint64_t bytes);

    // Bytes of each purpose that has any.
    [[nodiscard]] std::map<std::string, uint64_t> byPurpose() const;
    [[nodiscard]] uint64_t totalBytes() const;
    // Another number after every change.
    [[nodiscard]] uint64_t version() const;

  private:
    mutable std::mutex mutex_;
    std::map<std::string, uint64_t, std::less<>> bytes_;
    uint64_t version_ = 0;
};

} // namespace froxel::gpu
