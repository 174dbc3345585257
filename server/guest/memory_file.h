// A file in memory that grows until it is complete, and never changes then (memfd_create).
#pragma once

#include "core/error.h"
#include "guest/guest_scene.h"

#include <cstddef>
#include <span>
#include <string>

namespace froxel::guest {

class MemoryFile {
  public:
    // Errors: kIo, here and below: the system has no memory or no descriptor left.
    [[nodiscard]] static Result<MemoryFile> make();
    [[nodiscard]] Result<void> append(std::span<const std::byte> bytes);
    // Nobody writes it any more.
    [[nodiscard]] Result<GuestFile> complete(std::string name) &&;

  private:
    explicit MemoryFile(FileDescriptor descriptor) : descriptor_(std::move(descriptor)) {}

    FileDescriptor descriptor_;
    uint64_t size_bytes_ = 0;
};

} // namespace froxel::guest
