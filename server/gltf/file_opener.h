// How whoever reads a scene gets at its files: from their folder, or from a process that has it.
#pragma once

#include "core/file_descriptor.h"
#include "core/kept_bytes.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace froxel::gltf {

struct OpenedFile {
    FileDescriptor descriptor; // a regular file, for reading
    uint64_t size_bytes = 0;
    std::string shown{};            // its name as messages have it, printable
    uint64_t begin = 0;             // where in it the bytes are
    std::vector<std::byte> bytes{}; // instead of a descriptor: the file itself
};

// Of one thread. All throw Failure: Unusable where there is no such file, or none that may be read.
class FileOpener {
  public:
    virtual ~FileOpener() = default;

    // The scene's file itself.
    [[nodiscard]] virtual OpenedFile openScene() = 0;

    // One beside it or below; `relative` is not trusted. `user` is who is named in the message.
    [[nodiscard]] virtual OpenedFile open(const std::filesystem::path& relative,
                                          const std::string& user) = 0;

    // For the pixels of an image, which are wanted where the opener is. Any thread.
    [[nodiscard]] virtual KeptBytes pixelRoom(size_t size_bytes) { return KeptBytes(size_bytes); }
};

} // namespace froxel::gltf
