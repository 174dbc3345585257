#include "guest/memory_file.h"

#include "core/write_all.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <system_error>
#include <utility>

namespace froxel::guest {

namespace {

Error systemError() {
    return {ErrorCode::kIo,
            "no memory is left for the scene: " + std::generic_category().message(errno)};
}

} // namespace

Result<MemoryFile> MemoryFile::make() {
    FileDescriptor descriptor(memfd_create("froxel guest", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (!descriptor) {
        return systemError();
    }
    return MemoryFile(std::move(descriptor));
}

Result<void> MemoryFile::append(std::span<const std::byte> bytes) {
    if (!writeAll(descriptor_.get(), bytes)) {
        return systemError();
    }
    size_bytes_ += bytes.size();
    return {};
}

Result<GuestFile> MemoryFile::complete(std::string name) && {
    constexpr int kForGood = F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE;
    if (fcntl(descriptor_.get(), F_ADD_SEALS, kForGood) != 0) {
        return systemError();
    }
    return GuestFile{std::move(name), std::move(descriptor_), size_bytes_};
}

} // namespace froxel::guest
