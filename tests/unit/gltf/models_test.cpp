// Real files of others, as exporters wrote them; not part of the repository, so skipped where they
// are not there.
#include "gltf/gltf_loader.h"
#include "scene/scene_check.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>
#include <string>

namespace froxel::gltf {
namespace {

TEST(Models, AllOfThem_CanBeDrawn) {
    const auto folder = froxel::test::repositoryPath("../shared/scenes/models");
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

// Of 4x4 texels; ETC1S has four at most.
size_t colorsOfBlock(const scene::Image& image, uint32_t x, uint32_t y) {
    std::set<uint32_t> colors;
    for (uint32_t i = 0; i < 16; ++i) {
        uint32_t color = 0;
        std::memcpy(&color, &image.rgba8[4 * (size_t{y + i / 4} * image.width_px + x + i % 4)], 4);
        colors.insert(color);
    }
    return colors.size();
}

TEST(Models, JetFighter_HasItsTexturesAndTheirLevels) {
    const auto file =
        froxel::test::repositoryPath("../shared/scenes/models/fighter-jet/jet-fighter.glb");
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "no model at " << file;
    }
    const Result<scene::Scene> scene = load(file);
    ASSERT_TRUE(scene.has_value()) << scene.error().message;
    EXPECT_TRUE(scene->warnings.empty());
    ASSERT_EQ(scene->images.size(), 3U);
    for (const scene::Image& image : scene->images) {
        EXPECT_EQ(image.width_px, 4096U);
        ASSERT_EQ(image.mips.size(), 12U);
        for (uint32_t y = 0; y < image.height_px; y += 128) {
            for (uint32_t x = 0; x < image.width_px; x += 128) {
                ASSERT_LE(colorsOfBlock(image, x, y), 4U) << x << " " << y;
            }
        }
        // A level is about what halving the one before gives: nothing is shifted or swapped.
        double sum = 0;
        for (size_t i = 0; i < image.mips[0].size(); ++i) {
            const size_t pixel = i / 4;
            const size_t at = 4 * (pixel / 2048 * 2 * 4096 + pixel % 2048 * 2) + i % 4;
            int four = 0;
            for (const size_t next : {size_t{0}, size_t{4}, size_t{4} * 4096, size_t{4} * 4097}) {
                four += std::to_integer<int>(image.rgba8[at + next]);
            }
            sum += std::abs(four / 4.0 - std::to_integer<int>(image.mips[0][i]));
        }
        EXPECT_LT(sum / static_cast<double>(image.mips[0].size()), 3);
    }
}

} // namespace
} // namespace froxel::gltf
