// A file that is replaced as a whole: readers see the old one or the new one.
#pragma once

#include "core/error.h"
#include "core/file_descriptor.h"
#include "core/write_all.h"

#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <span>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace froxel {

// Has what was created, renamed or removed in a folder outlive a crash of the machine. 0, or errno.
[[nodiscard]] inline int syncFolder(const std::filesystem::path& folder) {
    const FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    return opened && ::fsync(opened.get()) == 0 ? 0 : errno;
}

// Whether the new file outlives a crash of the machine, for which the disk is waited for.
enum class Durable : bool { kNo, kYes };

// Writes the parts, one after another; makes the folder (for its owner only) where it is missing.
// Errors: kIo.
[[nodiscard]] inline Result<void> replaceFile(const std::filesystem::path& file,
                                              std::span<const std::span<const std::byte>> parts,
                                              Durable durable) {
    const auto failed = [&](int code) {
        return Error{ErrorCode::kIo, "cannot write '" + file.string() +
                                         "': " + std::generic_category().message(code)};
    };
    std::error_code failure;
    if (std::filesystem::create_directories(file.parent_path(), failure)) {
        std::filesystem::permissions(file.parent_path(), std::filesystem::perms::owner_all,
                                     failure);
    }
    // A name of its own for each writer, and a rename at the end: nobody sees half a file.
    std::string temporary = file.string() + ".XXXXXX";
    const int handle = ::mkstemp(temporary.data());
    if (handle < 0) {
        return failed(errno);
    }
    int code = 0;
    for (const auto& part : parts) {
        if (code == 0 && !writeAll(handle, part)) {
            code = errno;
        }
    }
    if (code == 0 && durable == Durable::kYes && ::fsync(handle) != 0) {
        code = errno;
    }
    if (::close(handle) != 0 && code == 0) {
        code = errno;
    }
    if (code == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) {
        code = errno;
    }
    if (code == 0 && durable == Durable::kYes) {
        code = syncFolder(file.parent_path().empty() ? "." : file.parent_path());
    }
    if (code != 0) {
        ::unlink(temporary.c_str());
        return failed(code);
    }
    return {};
}

} // namespace froxel
