// Which animation of a file plays.
#include "app/scene_source.h"
#include "scene/motion.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace froxel::app {
namespace {

// A camera that two animations move by 4 along x in a second: "walk", and a nameless one.
class SceneSource : public testing::Test {
  protected:
    SceneSource() {
        std::ofstream(file_) << R"({"asset": {"version": "2.0"}, "scene": 0,
            "scenes": [{"nodes": [0]}], "nodes": [{"camera": 0}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
            "buffers": [{"byteLength": 32, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAIBAAAAAAAAAAAA="}],
            "bufferViews": [{"buffer": 0, "byteLength": 8},
                            {"buffer": 0, "byteOffset": 8, "byteLength": 24}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR",
                 "min": [0], "max": [1]},
                {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"}],
            "animations": [
                {"name": "walk", "samplers": [{"input": 0, "output": 1}],
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
                {"samplers": [{"input": 0, "output": 1}],
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]})";
    }
    ~SceneSource() override { std::filesystem::remove(file_); }

    // None: it is refused.
    [[nodiscard]] std::optional<uint32_t> played(const std::string& animation) const {
        const auto scene = loadScene(file_, animation);
        return scene ? std::optional(scene->motion->played) : std::nullopt;
    }

    const std::string file_ = std::filesystem::path(testing::TempDir()) / "scene_source_test.gltf";
};

TEST_F(SceneSource, Animation_IsChosenByNameOrNumber) {
    EXPECT_EQ(played(""), 0U);
    EXPECT_EQ(played("walk"), 0U);
    EXPECT_EQ(played("2"), 1U);
    EXPECT_EQ(played("none"), scene::kNone);
}

TEST_F(SceneSource, UnknownAnimation_IsRefusedByName) {
    for (const char* unknown : {"0", "3", "-1", "1.5", "Walk", "\x1b"}) {
        EXPECT_EQ(played(unknown), std::nullopt) << unknown;
    }
    EXPECT_EQ(loadScene(file_, "run").error().message,
              "--animation: 'run' is no animation of this scene; it has 1 walk, 2 (nameless)");
    EXPECT_EQ(loadScene("builtin", "run").error().message,
              "--animation: 'run' is no animation of this scene; it has none");
    EXPECT_TRUE(loadScene("builtin", "none"));
}

// An empty scene is no room: it has no seeded lights.
TEST(FirstLook, WhatWasGiven_Stays_AndTheHallKeepsTheDefaults) {
    const scene::Scene scene;
    settings::ViewSettings asked;
    EXPECT_EQ(firstLook("builtin", scene, asked, {}), asked);
    EXPECT_EQ(firstLook("a.glb", scene, asked, {}).lights.count, 0U);
    EXPECT_EQ(firstLook("a.glb", scene, asked, {"lights"}), asked);
    asked.lights.count = 7;
    EXPECT_EQ(firstLook("a.glb", scene, asked, {"lights"}).lights.count, 7U);
}

} // namespace
} // namespace froxel::app
