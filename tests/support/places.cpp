#include "support/places.h"

#include <cstdlib>

namespace froxel::test {

std::filesystem::path repositoryPath(std::string_view below) {
    return std::filesystem::path(FROXEL_REPOSITORY) / below;
}

std::filesystem::path sponzaPath() {
    const char* given = std::getenv("FROXEL_SPONZA");
    return given != nullptr ? given : repositoryPath("../shared/scenes/sponza/Sponza.gltf");
}

std::string binaryPath() {
    return FROXEL_BINARY;
}

} // namespace froxel::test
