// A scene's files, of which the first, OBJ, PLY, STL or 3MF, is handed on as the GLB made of it.
#pragma once

#include "formats/model.h"
#include "gltf/file_opener.h"
#include "gltf/warnings.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::formats {

class GlbOpener final : public gltf::FileOpener {
  public:
    // `file`: whose name tells the format, one that `isConverted`. `memory_bytes`: what reading may
    // take.
    GlbOpener(gltf::FileOpener& files,
              std::filesystem::path file,
              uint64_t memory_bytes,
              gltf::Warnings& warnings)
        : files_(files), file_(std::move(file)), memory_bytes_(memory_bytes), warnings_(warnings) {}

    // Throws gltf::Failure, also where the file is of no such format.
    [[nodiscard]] gltf::OpenedFile openScene() override;
    [[nodiscard]] gltf::OpenedFile open(const std::filesystem::path& relative,
                                        const std::string& user) override {
        return files_.open(relative, user);
    }
    [[nodiscard]] KeptBytes pixelRoom(size_t size_bytes) override {
        return files_.pixelRoom(size_bytes);
    }

    // By its name: no glTF.
    [[nodiscard]] static bool isConverted(const std::filesystem::path& file);

  private:
    [[nodiscard]] Model readModel(std::string_view ending, const std::vector<std::byte>& bytes);
    [[nodiscard]] std::optional<std::vector<std::byte>> openBeside(const std::string& path);

    gltf::FileOpener& files_;
    const std::filesystem::path file_;
    const uint64_t memory_bytes_;
    gltf::Warnings& warnings_;
};

} // namespace froxel::formats
