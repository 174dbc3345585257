// What whoever waits for a scene hears, and how it is called off.
#include "unit/gltf/image_files.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <gmock/gmock.h>
#include <string>
#include <vector>

namespace froxel::gltf {
namespace {

using test::SceneFile;
using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;

// The triangle with many images.
std::filesystem::path manyImages(const TempFolder& folder) {
    SceneFile file;
    file.attributes()["TEXCOORD_0"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
    file.primitive()["material"] = 0;
    for (size_t i = 0; i < 3; ++i) {
        constexpr const char* kSlots[] = {"emissiveTexture", "occlusionTexture", "normalTexture"};
        file.json["materials"][0][kSlots[i]]["index"] = i;
        file.json["textures"].push_back({{"source", i}});
        file.json["images"].push_back(
            {{"mimeType", "image/jpeg"},
             {"bufferView", file.addView(test::jpegFile(64, 200, 100, 50, false))}});
    }
    return folder.write("many.glb", file.glb());
}

TEST(LoadProgress, IsToldFromStageToStage) {
    const TempFolder folder;
    std::vector<std::string> stages;
    std::vector<double> fractions;
    const auto scene = load(manyImages(folder), [&](const Progress& progress) {
        stages.push_back(progress.stage);
        fractions.push_back(progress.fraction);
        return true;
    });
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->images.size(), 3U);
    EXPECT_EQ(stages.front(), "reading the scene");
    EXPECT_THAT(stages, Contains("decoding its images"));
    EXPECT_TRUE(std::ranges::is_sorted(fractions));
    EXPECT_GE(fractions.front(), 0.0);
    EXPECT_LE(fractions.back(), 1.0);
}

TEST(LoadProgress, CalledOff_EndsAtAnyStage) {
    const TempFolder folder;
    const auto file = manyImages(folder);
    for (const std::string last : {"reading the scene", "decoding its images"}) {
        int calls_after = 0;
        const auto scene = load(file, [&](const Progress& progress) {
            calls_after += progress.stage == last ? 1 : 0;
            return progress.stage != last;
        });
        ASSERT_FALSE(scene) << last;
        EXPECT_EQ(scene.error().code, ErrorCode::kCancelled);
        EXPECT_THAT(scene.error().message,
                    HasSubstr("many.glb: cancelled, because nobody waits for it"));
        EXPECT_EQ(calls_after, 1);
    }
}

} // namespace
} // namespace froxel::gltf
