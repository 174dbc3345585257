// The only way to the file system: files inside the folder that the scene file lies in.
#pragma once

#include "gltf/limits.h"
#include "gltf/load_progress.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace froxel::gltf {

using Bytes = std::vector<std::byte>;

// The path that a relative URI of a glTF file names: percent-decoded, with slashes for backslashes,
// without a query and a fragment. Throws Unusable for a URI with a scheme, and where that path is
// absolute, has a `..` part or a NUL; `user` is named in the message.
[[nodiscard]] std::filesystem::path relativePathFromUri(const std::string& uri,
                                                        const std::string& user);

class SceneFolder {
  public:
    // `no_link`: as LoadLimits has it.
    SceneFolder(const std::filesystem::path& scene_file,
                bool no_link,
                LoadProgress& progress,
                ReadMemory& memory);

    // The scene file itself. Throws Failure, as all here; CalledOff.
    [[nodiscard]] Bytes readSceneFile();

    // The bytes behind a base64 `data:` URI of any type or a file of the folder; a symlink may lead
    // only to a place inside the folder. Throws Failure, naming `user`: Unusable where the URI is
    // wrong, there is no such file or the base64 text is broken.
    [[nodiscard]] Bytes read(const std::string& uri, const std::string& user);

    // Of all files that were read.
    [[nodiscard]] uint64_t fileBytes() const { return file_bytes_; }

  private:
    [[nodiscard]] Bytes
    readIn(const std::filesystem::path& path, bool canonical, const std::string& user);

    std::filesystem::path scene_file_;
    bool no_link_;
    std::filesystem::path folder_; // canonical
    LoadProgress& progress_;
    Budget bytes_;
    uint64_t file_bytes_ = 0;
};

} // namespace froxel::gltf
