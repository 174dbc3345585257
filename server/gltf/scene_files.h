// The bytes of a scene's files, within its memory.
#pragma once

#include "gltf/bytes.h"
#include "gltf/file_opener.h"
#include "gltf/limits.h"
#include "gltf/load_progress.h"

#include <cstdint>
#include <functional>
#include <string>

namespace froxel::gltf {

// All of a file. `ask` is called between its parts, and may throw. Throws Failure where it cannot
// be read; Unusable for a Git LFS pointer.
[[nodiscard]] Bytes readAll(
    const OpenedFile& file, const std::string& user, const std::function<void()>& ask = [] {});

class SceneFiles {
  public:
    SceneFiles(FileOpener& opener, LoadProgress& progress, ReadMemory& memory)
        : opener_(opener), progress_(progress), bytes_("bytes of files", kMaxFileBytes, 1, memory) {
    }

    // The scene file itself. Throws Failure, as all here; CalledOff.
    [[nodiscard]] Bytes readSceneFile();

    // The bytes behind a `data:` URI of any type or a file of the folder. Throws Failure, naming
    // `user`: Unusable where the URI is wrong, there is no such file, it cannot be read or the
    // `data:` URI cannot be decoded.
    [[nodiscard]] Bytes read(const std::string& uri, const std::string& user);

    // As FileOpener has it.
    [[nodiscard]] KeptBytes pixelRoom(size_t size_bytes) { return opener_.pixelRoom(size_bytes); }

    // Of all files that were read.
    [[nodiscard]] uint64_t fileBytes() const { return file_bytes_; }

  private:
    [[nodiscard]] Bytes take(OpenedFile file, const std::string& user);

    FileOpener& opener_;
    LoadProgress& progress_;
    Budget bytes_;
    uint64_t file_bytes_ = 0;
};

} // namespace froxel::gltf
