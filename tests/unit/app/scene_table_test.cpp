#include "app/scene_table.h"
#include "support/places.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace froxel::app {
namespace {

namespace fs = std::filesystem;

TEST(SceneTable, HasARowForEachFile_AndWhyItCannotBeRead) {
    const fs::path folder = fs::path(testing::TempDir()) / "froxel_scene_table_test";
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::copy_file(test::repositoryPath("tests/deploy/triangle.gltf"), folder / "triangle.gltf");
    std::ofstream(folder / "broken.glb") << "this is no GLB";
    const auto rows = scenesReport(folder, bake::Sandbox::kOff);
    fs::remove_all(folder);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("path"), "broken.glb");
    EXPECT_EQ(rows[0].at("bytes"), 14);
    EXPECT_NE(rows[0].at("problem").get<std::string>().find("broken.glb"), std::string::npos);
    EXPECT_EQ(rows[1].at("triangles"), 1);
    EXPECT_GT(rows[1].at("device_bytes"), 0);

    const std::string table = sceneTable(rows);
    EXPECT_EQ(std::ranges::count(table, '\n'), 3);
    EXPECT_EQ(table.find("path"), 0U);
    EXPECT_NE(table.find("broken.glb        14  "), std::string::npos) << table;
}

TEST(SceneTable, NamesOfOtherAlphabets_AreAsTheyAre_AndControlCharactersAreNot) {
    const auto rows = nlohmann::ordered_json::array(
        {{{"path", "caf\u00e9.glb"}, {"bytes", 7}, {"problem", ""}},
         {{"path", "a\x1B[2J\xC2\x9B.glb"}, {"bytes", 7}, {"problem", ""}}});
    const std::string table = sceneTable(rows);
    EXPECT_NE(table.find("caf\u00e9.glb               "), std::string::npos) << table;
    EXPECT_NE(table.find("a\\u001b[2J\\u009b.glb"), std::string::npos) << table;
}

} // namespace
} // namespace froxel::app
