// How often the device was lost, over runs: a process that loses it ends before anybody has scraped
// that, and the next one tells.
#pragma once

#include <cstdint>
#include <filesystem>

namespace froxel::app {

// One thread at a time.
class DeviceLosses {
  public:
    // Notes them in a file of `folder`; empty: nowhere, and only those of this run count.
    explicit DeviceLosses(const std::filesystem::path& folder);

    [[nodiscard]] uint64_t count() const { return count_; }
    // A folder that cannot be written is no failure: one line in the log.
    void add();

  private:
    std::filesystem::path file_; // empty: none
    uint64_t count_ = 0;
};

} // namespace froxel::app
