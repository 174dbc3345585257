// A file in memory, for what reads files only: as quick as its bytes.
#pragma once

#include "core/assert.h"

#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace froxel::fuzz {

class MemoryFile {
  public:
    MemoryFile() : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
        FROXEL_ASSERT(descriptor_ >= 0, "no file in memory");
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    void write(std::string_view bytes) const {
        const bool done =
            ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, bytes.data(), bytes.size(), 0) ==
                                                  static_cast<ssize_t>(bytes.size());
        FROXEL_ASSERT(done, "no room in memory");
    }
    [[nodiscard]] std::string path() const {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

  private:
    int descriptor_;
};

} // namespace froxel::fuzz
