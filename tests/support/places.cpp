#include "support/places.h"

#include <cstdlib>

namespace froxel::test {

std::filesystem::path repositoryPath(std::string_view below) {
    const char* given = std::getenv("FROXEL_REPOSITORY"); // where binaries run elsewhere
    return std::filesystem::path(given != nullptr ? given : FROXEL_REPOSITORY) / below;
}

std::filesystem::path sponzaPath() {
    const char* given = std::getenv("FROXEL_SPONZA");
    return given != nullptr ? given : repositoryPath("../shared/scenes/sponza/Sponza.gltf");
}

std::string binaryPath() {
    const char* given = std::getenv("FROXEL_BINARY");
    return given != nullptr ? given : FROXEL_BINARY;
}

} // namespace froxel::test
