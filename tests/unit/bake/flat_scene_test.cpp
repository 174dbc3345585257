#include "bake/flat_scene.h"
#include "builtin_scene/hall.h"
#include "gltf/gltf_loader.h"
#include "scene/motion.h"
#include "scene/scene_check.h"
#include "support/places.h"
#include "unit/bake/flat_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace froxel::bake {
namespace {

using Bytes = std::vector<std::byte>;

// Every member is written, as the compiler checks; so equal bytes are equal scenes.
void expectReturns(const scene::Scene& scene) {
    const Bytes bytes = flat(scene);
    const auto read = readFlat(bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(flat(*read) == bytes);
}

TEST(FlatScene, AScene_ReturnsAsItWas) {
    expectReturns(smallScene());
    expectReturns(scene::Scene());
    expectReturns(builtin_scene::makeHall());
    const auto read = readFlat(flat(smallScene()));
    EXPECT_EQ(read->materials[0].base_color_texture.texture, 0U);
    EXPECT_EQ(read->motion->clips[0].tracks[0].times_s[1], 1);
    EXPECT_EQ(read->warnings[0], smallScene().warnings[0]);
}

TEST(FlatScene, RealFiles_ReturnAsTheyWere) {
    const auto folder = test::repositoryPath("../shared/scenes");
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "no files of others at " << folder;
    }
    size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension();
        if (extension == ".glb" || extension == ".gltf") {
            SCOPED_TRACE(entry.path());
            if (const auto scene = gltf::load(entry.path())) {
                expectReturns(*scene);
                ++count;
            }
        }
    }
    EXPECT_GT(count, 20U);
}

// Images that both sides see are told by their place, which must be within what both see.
TEST(FlatScene, ImagesInAPool_AreSharedAndStayInIt) {
    const auto pool = std::make_shared<Bytes>(64, std::byte{9});
    scene::Scene scene = smallScene();
    scene.images[0].rgba8 = KeptBytes(std::span(*pool).subspan(40, 8), pool);
    const Bytes bytes = flat(scene, *pool);
    const auto read = readFlat(bytes, *pool, pool);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->images[0].rgba8.span().data(), pool->data() + 40);
    EXPECT_EQ(pool.use_count(), 3);
    for (const size_t size : {0U, 8U, 47U}) {
        EXPECT_FALSE(readFlat(bytes, std::span(*pool).first(size), pool)) << size;
    }
    scene::Scene changed = *read;
    changed.images[0].rgba8[0] = std::byte{1}; // becomes its own
    EXPECT_EQ((*pool)[40], std::byte{9});
}

TEST(FlatScene, CutAnywhere_IsRefused) {
    const Bytes bytes = flat(smallScene());
    for (size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_FALSE(readFlat(std::span(bytes).first(size))) << size;
    }
    Bytes longer = bytes;
    longer.push_back({});
    EXPECT_FALSE(readFlat(longer));
}

// What is accepted can be drawn: no index leads out of its array.
TEST(FlatScene, ChangedBytes_AreRefusedOrHarmless) {
    const Bytes bytes = flat(smallScene());
    std::mt19937 random(67);
    size_t refused = 0;
    for (size_t at = 0; at < bytes.size(); ++at) {
        for (const int value : {0, 1, 2, 0x7f, 0x80, 0xff}) {
            Bytes changed = bytes;
            changed[at] = static_cast<std::byte>(value);
            const auto read = readFlat(changed);
            refused += read ? 0U : 1U;
            if (read) {
                EXPECT_EQ(scene::findFault(*read), std::nullopt) << at;
            }
        }
    }
    EXPECT_GT(refused, bytes.size());
}

// No more memory than in proportion to the bytes, whatever they count.
TEST(FlatScene, CountsBeyondTheBytes_AreRefused) {
    const Bytes bytes = flat(smallScene());
    for (size_t at = 0; at + 8 <= bytes.size(); ++at) {
        Bytes changed = bytes;
        std::fill_n(changed.begin() + static_cast<std::ptrdiff_t>(at), 8, std::byte{0x7f});
        (void)readFlat(changed);
    }
}

struct Case {
    const char* name;
    std::function<void(scene::Scene&)> spoil;
    const char* told;
};

TEST(FlatScene, WhatReadersSeeTo_IsCheckedAgain) {
    const Case cases[] = {
        {"image", [](auto& s) { s.images[0].width_px = 3; }, "image 0"},
        {"no pixel",
         [](auto& s) {
             s.images[0].width_px = 0;
             s.images[0].rgba8.clear();
         },
         "image 0"},
        {"level", [](auto& s) { s.images[0].mips[0].resize(5); }, "image 0"},
        {"levels", [](auto& s) { s.images[0].mips.emplace_back(4); }, "image 0"},
        {"bounds", [](auto& s) { s.meshes[0].primitives[0].bounds.max.x = 2; }, "mesh 0"},
        {"index", [](auto& s) { s.meshes[0].primitives[0].indices[1] = 3; }, "indices 1"},
        {"eye", [](auto& s) { s.cameras[0].camera.eye_world.x = NAN; }, "camera 0"},
        {"axes", [](auto& s) { s.cameras[0].camera.world_from_view[0] *= 2; }, "camera 0"},
        {"angle", [](auto& s) { s.cameras[0].camera.yfov_rad = 4; }, "camera 0"},
        {"light", [](auto& s) { s.lights[0].intensity = INFINITY; }, "light 0"},
        {"cone", [](auto& s) { s.lights[0].inner_cone_rad = 2; }, "light 0"},
        {"line", [](auto& s) { s.warnings[0].message = "two\nlines"; }, "warning 0"},
        {"variant", [](auto& s) { s.material_variant = 2; }, "than a file may have"},
        {"name", [](auto& s) { s.cameras[0].name.assign(400, 'n'); }, "than a file may have"},
        {"cameras", [](auto& s) { s.cameras.resize(1025); }, "than a file may have"},
        {"all bounds", [](auto& s) { s.bounds_world.max.y = INFINITY; }, "bounds"},
    };
    for (const auto& [name, spoil, told] : cases) {
        scene::Scene scene = smallScene();
        spoil(scene);
        const auto read = readFlat(flat(scene));
        ASSERT_FALSE(read) << name;
        EXPECT_NE(read.error().message.find(told), std::string::npos) << read.error().message;
    }
}

} // namespace
} // namespace froxel::bake
