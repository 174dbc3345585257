// A scene and its files that come as one: the parts of a form (multipart/form-data, RFC 7578).
#pragma once

#include "gltf/file_opener.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace froxel::bake {

// The opener's scene is the form, and its parts are the scene's files. A part is found by its
// filename, or else by the last component of what is asked for, since most clients send no folders.
class FormParts final : public gltf::FileOpener {
  public:
    static constexpr size_t kMostParts = 512;

    // Throws gltf::Failure: it is no form of this boundary, or not one part
    // is a scene by its name.
    FormParts(gltf::FileOpener& opener, const std::string& boundary);

    // Of the part that is the scene.
    [[nodiscard]] const std::string& sceneName() const { return parts_[scene_].name; }

    [[nodiscard]] gltf::OpenedFile openScene() override { return open(parts_[scene_]); }
    [[nodiscard]] gltf::OpenedFile open(const std::filesystem::path& relative,
                                        const std::string& user) override;
    [[nodiscard]] KeptBytes pixelRoom(size_t size_bytes) override {
        return opener_.pixelRoom(size_bytes);
    }

  private:
    struct Part {
        std::string name; // untrusted
        uint64_t begin = 0;
        uint64_t size_bytes = 0;
    };
    [[nodiscard]] gltf::OpenedFile open(const Part& part);
    void readParts(const std::string& boundary);

    gltf::FileOpener& opener_;
    std::vector<Part> parts_;
    size_t scene_ = 0;
};

} // namespace froxel::bake
