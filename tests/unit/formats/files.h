// Files in a folder of their own, loaded as scenes.
#pragma once

#include "formats/scene_loader.h"
#include "support/temp_folder.h"

#include <fstream>
#include <string>
#include <string_view>

namespace froxel::formats {

class Files {
  public:
    Files& add(const std::string& name, std::string_view content) {
        std::ofstream(folder_.path() / name, std::ios::binary)
            .write(content.data(), static_cast<std::streamsize>(content.size()));
        return *this;
    }
    [[nodiscard]] Result<scene::Scene> load(const std::string& name) const {
        return formats::load(folder_.path() / name);
    }
    // What is wrong with the file; "": nothing.
    [[nodiscard]] std::string faultOf(const std::string& name) const {
        const auto scene = load(name);
        return scene ? "" : scene.error().message;
    }

  private:
    test::TempFolder folder_{"formats"};
};

inline bool warns(const scene::Scene& scene, std::string_view words) {
    return std::ranges::any_of(scene.warnings, [&](const scene::Warning& warning) {
        return warning.message.find(words) != std::string::npos;
    });
}

} // namespace froxel::formats
