// Image files: formats, sources and broken ones.
#include "unit/gltf/image_files.h"
#include "unit/gltf/scene_file.h"
#include "unit/png/png_file.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::gltf {
namespace {

using froxel::test::plainPng;
using froxel::test::pngClaiming;
using test::Bytes;
using test::failure;
using test::Json;
using test::loaded;
using test::SceneFile;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

// The triangle with `count` textures of as many images, which are for a test to fill in.
SceneFile withImages(size_t count) {
    constexpr const char* kSlots[] = {"emissiveTexture", "occlusionTexture", "normalTexture"};
    SceneFile file;
    file.primitive()["material"] = 0;
    for (size_t i = 0; i < count; ++i) {
        file.json["materials"][0][kSlots[i]]["index"] = i;
        file.json["textures"].push_back({{"source", i}});
        file.json["images"].push_back(Json::object());
    }
    return file;
}

SceneFile withImage(const Bytes& image) {
    SceneFile file = withImages(1);
    file.json["images"][0]["bufferView"] = file.addView(image);
    return file;
}

std::vector<int> pixelsOf(const Bytes& image) {
    const scene::Scene scene = loaded(withImage(image).load());
    std::vector<int> values;
    if (scene.images.size() == 1) {
        for (const std::byte value : scene.images[0].rgba8) {
            values.push_back(std::to_integer<int>(value));
        }
    }
    return values;
}

TEST(Images, Png_BecomesRgba) {
    EXPECT_THAT(pixelsOf(plainPng(1, 2, 3)), ElementsAre(1, 2, 3, 255));
}

TEST(Images, Jpeg_BecomesRgba) {
    const std::vector<int> pixels = pixelsOf(test::jpegFile(8, 200, 100, 50, false));
    ASSERT_EQ(pixels.size(), 256U);
    EXPECT_NEAR(pixels[0], 200, 3);
    EXPECT_NEAR(pixels[1], 100, 3);
    EXPECT_NEAR(pixels[2], 50, 3);
    EXPECT_EQ(pixels[3], 255);
}

TEST(Images, GreyJpeg_BecomesRgba) {
    const std::vector<int> pixels = pixelsOf(test::jpegFile(8, 90, 90, 90, true));
    ASSERT_EQ(pixels.size(), 256U);
    EXPECT_EQ(pixels[0], pixels[2]);
    EXPECT_NEAR(pixels[0], 90, 3);
    EXPECT_EQ(pixels[3], 255);
}

TEST(Images, FileInASubfolder_IsRead) {
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "my textures");
    folder.write("my textures/a.png", plainPng(1, 2, 3));
    SceneFile file = withImages(1);
    file.json["images"][0]["uri"] = "my%20textures/a.png";
    const scene::Scene scene = loaded(file.loadIn(folder));
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.images[0].rgba8.at(2), std::byte{3});
}

TEST(Images, DataUri_IsRead) {
    SceneFile file = withImages(2);
    file.json["images"][0]["uri"] = "data:image/png;base64," + test::base64(plainPng(1, 2, 3));
    file.json["images"][1]["uri"] =
        "data:image/jpeg;base64," + test::base64(test::jpegFile(8, 9, 9, 9, true));
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.images.size(), 2U);
    EXPECT_EQ(scene.images[0].width_px + scene.images[1].width_px, 9U);
}

TEST(Images, Missing_IsRefused) {
    SceneFile file = withImages(1);
    EXPECT_THAT(failure(file.load()), HasSubstr("image 0 has neither uri nor bufferView"));
    file.json["images"][0]["uri"] = "missing.png";
    EXPECT_THAT(failure(file.load()), HasSubstr("image 0 cannot open 'missing.png'"));
    file.json["images"][0] = {{"bufferView", 99}};
    EXPECT_THAT(failure(file.load()), HasSubstr("image 0 uses bufferView 99"));
}

TEST(Images, OtherFormat_IsRefused) {
    EXPECT_THAT(failure(withImage(Bytes(64, std::byte{0x42})).load()),
                HasSubstr("image 0 is neither a PNG nor a JPEG"));
    EXPECT_THAT(failure(withImage(Bytes(1, std::byte{0x89})).load()),
                HasSubstr("image 0 is neither"));
}

TEST(Images, TruncatedPng_IsRefused) {
    Bytes image = plainPng(1, 2, 3);
    image.resize(image.size() - 20);
    EXPECT_THAT(failure(withImage(image).load()), HasSubstr("image 0 is a broken PNG file"));
    image.resize(20);
    EXPECT_THAT(failure(withImage(image).load()), HasSubstr("image 0 is a broken PNG file"));
}

TEST(Images, DamagedPng_IsRefused) {
    Bytes image = plainPng(1, 2, 3);
    image.at(45) ^= std::byte{0xFF};
    EXPECT_THAT(failure(withImage(image).load()), HasSubstr("image 0 is a broken PNG file"));
}

TEST(Images, TruncatedJpeg_WarnsOrIsRefused) {
    Bytes image = test::jpegFile(64, 200, 100, 50, false);
    Bytes without_header = image;
    without_header.resize(12);
    EXPECT_THAT(failure(withImage(without_header).load()),
                HasSubstr("image 0 is a broken JPEG file"));
    image.resize(image.size() - 40);
    EXPECT_THAT(loaded(withImage(image).load()).warnings, ElementsAre(HasSubstr("image 0")));
}

TEST(Images, SideTooLong_IsRefusedByItsHeader) {
    EXPECT_THAT(failure(withImage(pngClaiming(100'000, 2)).load()),
                HasSubstr("image 0 has 100000x2 pixels; a side may have 1 to 16384"));
}

// Each image alone is within the limits; the file says nothing of its pixels, so only the sum of
// the headers can refuse it this fast.
TEST(Images, SumTooLarge_IsRefusedByTheHeaders) {
    SceneFile file = withImages(3);
    constexpr const char* kSlots[] = {"baseColorTexture", "metallicRoughnessTexture"};
    for (size_t i = 0; i < 2; ++i) {
        file.json["materials"][0]["pbrMetallicRoughness"][kSlots[i]]["index"] = 3 + i;
        file.json["textures"].push_back({{"source", 3 + i}});
        file.json["images"].push_back(Json::object());
    }
    const int view = file.addView(pngClaiming(16384, 16384));
    for (Json& image : file.json["images"]) {
        image["bufferView"] = view;
    }
    EXPECT_THAT(failure(file.load()), HasSubstr("needs 1073741824 bytes of decoded images"));
}

TEST(Images, LowestBrokenOne_IsNamed) {
    SceneFile file = withImages(3);
    Bytes broken = plainPng(1, 2, 3);
    broken.at(45) ^= std::byte{0xFF};
    file.json["images"][0]["bufferView"] = file.addView(plainPng(1, 2, 3));
    file.json["images"][1]["bufferView"] = file.addView(broken);
    file.json["images"][2]["bufferView"] = file.addView(broken);
    // Slots are met in the order normal, occlusion, emissive.
    EXPECT_THAT(failure(file.load()), HasSubstr("image 2 "));
}

} // namespace
} // namespace froxel::gltf
