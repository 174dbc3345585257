// The only way to the file system: files inside the folder that the scene file lies in.
#pragma once

#include "core/file_stamp.h"
#include "gltf/bytes.h"
#include "gltf/limits.h"
#include "gltf/load_progress.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace froxel::gltf {

class SceneFolder {
  public:
    // `no_link`: as LoadLimits has it.
    SceneFolder(const std::filesystem::path& scene_file,
                bool no_link,
                LoadProgress& progress,
                ReadMemory& memory);

    // The scene file itself. Throws Failure, as all here; CalledOff.
    [[nodiscard]] Bytes readSceneFile();

    // The bytes behind a `data:` URI of any type or a file of the folder; a symlink may lead only
    // to a place inside the folder. Throws Failure, naming `user`: Unusable where the URI is wrong,
    // there is no such file, it cannot be read or the `data:` URI cannot be decoded.
    [[nodiscard]] Bytes read(const std::string& uri, const std::string& user);

    // Of all files that were read.
    [[nodiscard]] uint64_t fileBytes() const { return file_bytes_; }

    // All that were opened or looked for, the scene's own first.
    [[nodiscard]] std::vector<StampedFile> takeFiles() { return std::move(files_); }

  private:
    // The last of files_; `canonical`: the path is, and must still be.
    [[nodiscard]] Bytes
    readFile(const std::filesystem::path& path, bool canonical, const std::string& user);
    [[nodiscard]] std::string shownPath(const std::filesystem::path& path) const;

    std::filesystem::path scene_file_;
    bool no_link_;
    std::filesystem::path folder_; // canonical
    LoadProgress& progress_;
    Budget bytes_;
    uint64_t file_bytes_ = 0;
    std::vector<StampedFile> files_;
};

} // namespace froxel::gltf
