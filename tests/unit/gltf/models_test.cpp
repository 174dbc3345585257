// Real files of others, as exporters wrote them; not part of the repository, so skipped where they
// are not there.
#include "gltf/gltf_loader.h"
#include "scene/scene_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace froxel::gltf {
namespace {

TEST(Models, AllOfThem_CanBeDrawn) {
    const std::filesystem::path folder = FROXEL_MODELS_PATH;
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "no models at " << folder;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".glb" && extension != ".gltf") {
            continue;
        }
        const Result<scene::Scene> result = load(entry.path());
        ASSERT_TRUE(result.has_value()) << result.error().message;
        EXPECT_FALSE(result->instances.empty()) << entry.path();
        EXPECT_EQ(scene::findFault(*result), std::nullopt) << entry.path();
        for (const scene::Warning& warning : result->warnings) {
            RecordProperty(entry.path().filename(), warning.code + ": " + warning.message);
        }
    }
}

} // namespace
} // namespace froxel::gltf
