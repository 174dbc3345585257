// What of a file is shown at first.
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
                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
            "extensionsUsed": ["KHR_materials_variants"],
            "extensions": {"KHR_materials_variants": {"variants": [{"name": "dusk"}, {}]}}})";
    }
    ~SceneSource() override { std::filesystem::remove(file_); }

    // None: it is refused.
    [[nodiscard]] std::optional<uint32_t> played(const std::string& animation) const {
        const auto scene = loadScene(file_, {.animation = animation});
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
    EXPECT_EQ(loadScene(file_, {.animation = "run"}).error().message,
              "--animation: 'run' names no animation of this scene; it has 1 walk, 2 (nameless)");
    EXPECT_EQ(loadScene("builtin", {.animation = "run"}).error().message,
              "--animation: 'run' names no animation of this scene; it has none");
    EXPECT_TRUE(loadScene("builtin", {.animation = "none"}));
}

TEST_F(SceneSource, MaterialVariant_IsChosenByNameOrNumber) {
    const auto shown = [&](const char* variant) {
        return loadScene(file_, {.material_variant = variant}).value().material_variant;
    };
    EXPECT_EQ(shown(""), 0U);
    EXPECT_EQ(shown("dusk"), 1U);
    EXPECT_EQ(shown("2"), 2U);
    EXPECT_EQ(shown("none"), 0U);
    EXPECT_EQ(loadScene(file_, {.material_variant = "3"}).error().message,
              "--material-variant: '3' names no material variant of this scene; it has 1 dusk, 2 "
              "(nameless)");
    EXPECT_EQ(loadScene("builtin", {.material_variant = "1"}).error().message,
              "--material-variant: '1' names no material variant of this scene; it has none");
}

// An empty scene is no room: it has no seeded lights.
TEST(FirstLook, WhatWasGiven_Stays_AndTheHallKeepsTheDefaults) {
    const scene::Scene scene;
    settings::ViewSettings asked;
    const auto first = [&](const char* source, const GivenSettings& given) {
        return firstLook(source, scene, asked, given, nullptr, true);
    };
    EXPECT_EQ(first("builtin", {}), asked);
    EXPECT_EQ(first("a.glb", {}).lights.count, 0U);
    EXPECT_EQ(first("a.glb", {"lights"}).lights.count, asked.lights.count);
    asked.lights.count = 7;
    EXPECT_EQ(first("a.glb", {"lights"}).lights.count, 7U);
}

TEST(FirstLook, NamedLook_GoesBeforeTheScene_AndAfterWhatWasGiven) {
    const scene::Scene scene;
    settings::ViewSettings asked;
    asked.lights.count = 7;
    const scene::Look* look = scene::findLook("evening");
    ASSERT_NE(look, nullptr);
    for (const char* source : {"builtin", "a.glb"}) {
        EXPECT_EQ(firstLook(source, scene, asked, {}, look, true).lights.count, 1000U);
        const auto given = firstLook(source, scene, asked, {"lights"}, look, true);
        EXPECT_EQ(given.lights.count, 7U);
        EXPECT_EQ(given.lights.palette, settings::LightPalette::kWarm);
    }
}

} // namespace
} // namespace froxel::app
