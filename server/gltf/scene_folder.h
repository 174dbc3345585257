// The only way to the file system: files inside the folder that the scene file lies in.
#pragma once

#include "core/file_stamp.h"
#include "gltf/file_opener.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace froxel::gltf {

class SceneFolder final : public FileOpener {
  public:
    // `no_link`: as LoadLimits has it. Throws Failure.
    SceneFolder(const std::filesystem::path& scene_file, bool no_link);

    [[nodiscard]] OpenedFile openScene() override;

    // A symlink may lead only to a place inside the folder.
    [[nodiscard]] OpenedFile open(const std::filesystem::path& relative,
                                  const std::string& user) override;

    // All that were opened or looked for, the scene's own first.
    [[nodiscard]] std::vector<StampedFile> takeFiles() { return std::move(files_); }

  private:
    // The last of files_; `canonical`: the path is, and must still be.
    [[nodiscard]] OpenedFile
    openFile(const std::filesystem::path& path, bool canonical, const std::string& user);
    [[nodiscard]] std::string shownPath(const std::filesystem::path& path) const;

    std::filesystem::path scene_file_;
    bool no_link_;
    std::filesystem::path folder_; // canonical
    std::vector<StampedFile> files_;
};

} // namespace froxel::gltf
