// A guest scene's files for whoever reads the scene. They are found by name alone: no name that a
// client chose becomes a path.
#pragma once

#include "gltf/file_opener.h"
#include "guest/guest_scene.h"

#include <memory>
#include <string>

namespace froxel::bake {

class GuestFiles final : public gltf::FileOpener {
  public:
    explicit GuestFiles(std::shared_ptr<const guest::GuestScene> scene)
        : scene_(std::move(scene)) {}

    [[nodiscard]] gltf::OpenedFile openScene() override;
    [[nodiscard]] gltf::OpenedFile open(const std::filesystem::path& relative,
                                        const std::string& user) override;

  private:
    const std::shared_ptr<const guest::GuestScene> scene_;
};

} // namespace froxel::bake
