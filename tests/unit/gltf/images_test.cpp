// Image files: formats, sources and broken ones.
#include "unit/gltf/image_files.h"
#include "unit/gltf/scene_file.h"
#include "unit/ktx2/ktx2_file.h"
#include "unit/png/png_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <gmock/gmock.h>
#include <map>
#include <numeric>
#include <string>
#include <sys/stat.h>

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
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

// The triangle with `count` textures of as many images, which are for a test to fill in.
SceneFile withImages(size_t count) {
    constexpr const char* kSlots[] = {"emissiveTexture", "occlusionTexture", "normalTexture"};
    SceneFile file;
    file.attributes()["TEXCOORD_0"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
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
    EXPECT_EQ(scene.images[0].rgba8[2], std::byte{3});
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

// The one material of a scene that goes without its texture, and why.
std::string leftOut(const SceneFile& file) {
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.materials.at(0).emissive_texture.texture, scene::kNone);
    EXPECT_EQ(scene.images.at(0).rgba8, Bytes(4, std::byte{255})) << "nothing uses it";
    const std::vector<std::string> lines = test::warningLines(scene);
    EXPECT_EQ(lines.size(), 1U);
    return lines.empty() ? "" : lines[0];
}

TEST(Images, Missing_LeavesItsTexturesOut) {
    SceneFile file = withImages(1);
    EXPECT_THAT(leftOut(file), HasSubstr("image 0 has neither uri nor bufferView"));
    file.json["images"][0]["uri"] = "missing.png";
    EXPECT_THAT(leftOut(file), AllOf(HasSubstr("FILE_NOT_FOUND at /images/0"),
                                     HasSubstr("image 0 cannot open 'missing.png'")));
    file.json["images"][0]["uri"] = "data:image/png,";
    EXPECT_THAT(leftOut(file), HasSubstr("cannot be decoded"));
}

// As one that is missing; nobody who is told needs to know where the server keeps its files.
TEST(Images, CannotBeRead_LeavesItsTexturesOut_AndTellsNoFolderOfTheServer) {
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "dir.png");
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.png").c_str(), 0600), 0);
    for (const char* name : {"dir.png", "pipe.png", "missing.png"}) {
        SceneFile file = withImages(1);
        file.json["images"][0]["uri"] = name;
        const auto scene = loaded(file.loadIn(folder));
        ASSERT_EQ(scene.warnings.size(), 1U) << name;
        EXPECT_EQ(scene.warnings[0].code, std::string("FILE_NOT_FOUND"));
        EXPECT_THAT(scene.warnings[0].message,
                    AllOf(HasSubstr(name), Not(HasSubstr(folder.path().string()))));
        EXPECT_EQ(scene.materials[0].emissive_texture.texture, scene::kNone);
    }
}

TEST(Files, WhatReadingOpenedOrLookedFor_IsTold) {
    const TempFolder folder;
    SceneFile file = withImages(2);
    file.json["images"][0]["uri"] = "missing.png";
    folder.write("broken.png", "no picture");
    file.json["images"][1]["uri"] = "textures/../broken.png";
    const auto scene = loaded(file.loadIn(folder));
    std::map<std::string, bool> there;
    for (const StampedFile& one : scene.files) {
        there[one.path.filename().string()] = one.stamp != 0;
        EXPECT_FALSE(one.hasChanged()) << one.path;
    }
    EXPECT_THAT(there, ElementsAre(Pair("broken.png", true), Pair("missing.png", false),
                                   Pair("scene.bin", true), Pair("scene.gltf", true)));
}

TEST(Images, OutOfRangeOrOutside_LeavesItsTexturesOut) {
    SceneFile file = withImages(1);
    file.json["images"][0] = {{"bufferView", 99}};
    EXPECT_THAT(leftOut(file), HasSubstr("image 0 uses bufferView 99"));
    for (const auto& [uri, why] : {std::pair("../secret.png", "leaves the scene's folder"),
                                   std::pair("https://a.org/b.png", "has a scheme"),
                                   std::pair("/etc/b.png", "is absolute")}) {
        file.json["images"][0] = {{"uri", uri}};
        EXPECT_THAT(leftOut(file), AllOf(HasSubstr("INVALID_URI at /images/0"), HasSubstr(why)));
    }
}

TEST(Images, OtherFormat_LeavesItsTexturesOut) {
    EXPECT_THAT(
        leftOut(withImage(Bytes(64, std::byte{0x42}))),
        HasSubstr("image 0 is of an unknown format (64 bytes); expected PNG, JPEG, WebP or"));
    EXPECT_THAT(leftOut(withImage(Bytes(1, std::byte{0x89}))), HasSubstr("unknown format (1 byte"));
}

TEST(Images, BrokenPng_LeavesItsTexturesOut) {
    Bytes image = plainPng(1, 2, 3);
    Bytes damaged = image;
    damaged.at(45) ^= std::byte{0xFF};
    EXPECT_THAT(leftOut(withImage(damaged)), HasSubstr("image 0 is a broken PNG file"));
    image.resize(image.size() - 20);
    EXPECT_THAT(leftOut(withImage(image)), HasSubstr("image 0 is a broken PNG file"));
    image.resize(20);
    EXPECT_THAT(leftOut(withImage(image)), HasSubstr("IMAGE_DATA_INVALID at /images/0"));
}

TEST(Images, BrokenJpeg_WarnsOrLeavesItsTexturesOut) {
    Bytes image = test::jpegFile(64, 200, 100, 50, false);
    Bytes without_header = image;
    without_header.resize(12);
    EXPECT_THAT(leftOut(withImage(without_header)), HasSubstr("image 0 is a broken JPEG file"));
    image.resize(image.size() - 40);
    const scene::Scene scene = loaded(withImage(image).load());
    EXPECT_THAT(test::warningLines(scene), ElementsAre(HasSubstr("image 0")));
    EXPECT_EQ(scene.materials.at(0).emissive_texture.texture, 0U);
}

TEST(Images, WrongMimeType_IsReadAsItIs) {
    SceneFile file = withImage(plainPng(1, 2, 3));
    file.json["images"][0]["mimeType"] = "image/jpeg";
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.images.at(0).rgba8[2], std::byte{3});
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("IMAGE_MIME_TYPE_INVALID at /images/0/mimeType")));
    EXPECT_EQ(scene.warnings.at(0).severity, scene::Severity::kInformation);
}

// 4 x 4 pixels, made by libwebp's encoder.
TEST(Images, LosslessWebp_HasItsPixels) {
    std::vector<uint8_t> rgba(64);
    std::iota(rgba.begin(), rgba.end(), uint8_t{100}); // no alpha of 0, whose colours are free
    const std::vector<int> pixels = pixelsOf(test::webpFile(rgba, 4));
    EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), rgba.begin(), rgba.end()));
}

TEST(Images, WebpOfTheExtension_WinsOverTheFallback) {
    SceneFile file = withImages(2);
    file.useExtension("EXT_texture_webp", true);
    file.json["images"][0]["bufferView"] = file.addView(plainPng(1, 2, 3));
    file.json["images"][1] = {
        {"bufferView", file.addView(test::webpFile(std::vector<uint8_t>(16, 77), 2))},
        {"mimeType", "image/webp"}};
    file.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    file.json["materials"][0].erase("occlusionTexture");
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.images.size(), 1U) << "the fallback is not read";
    EXPECT_EQ(scene.images[0].rgba8, Bytes(16, std::byte{77}));
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
}

TEST(Images, WebpInADataUri_IsRead) {
    SceneFile file = withImages(1);
    file.json["images"][0]["uri"] =
        "data:image/webp;base64," + test::base64(test::webpFile(std::vector<uint8_t>(16, 77), 2));
    EXPECT_EQ(loaded(file.load()).images.at(0).rgba8, Bytes(16, std::byte{77}));
}

TEST(Images, BrokenWebp_LeavesItsTexturesOut) {
    Bytes image = test::webpFile(std::vector<uint8_t>(16, 77), 2);
    Bytes cut = image;
    cut.resize(cut.size() - 4);
    EXPECT_THAT(leftOut(withImage(cut)), HasSubstr("image 0 is a broken WebP file"));
    image.resize(14);
    EXPECT_THAT(leftOut(withImage(image)), HasSubstr("image 0 is a broken WebP file"));
}

// An animation says so in its VP8X header: flag 2, then the canvas.
TEST(Images, WebpAnimation_LeavesItsTexturesOut) {
    const std::string file("RIFF\x16\0\0\0WEBPVP8X\x0A\0\0\0\x02\0\0\0\x03\0\0\x03\0\0", 30);
    const auto* first = reinterpret_cast<const std::byte*>(file.data());
    EXPECT_THAT(leftOut(withImage(Bytes(first, first + file.size()))),
                HasSubstr("image 0 is a WebP animation; expected one picture"));
}

TEST(Images, Ktx2_HasItsPixelsAndItsMips) {
    const SceneFile file = withImage(froxel::test::ktx2File(froxel::test::uastcLevels()));
    const scene::Scene scene = loaded(file.load());
    const scene::Image& image = scene.images.at(0);
    EXPECT_EQ(image.width_px, 8U);
    ASSERT_EQ(image.rgba8.size(), 256U);
    EXPECT_EQ(image.rgba8[0], std::byte{255});
    ASSERT_EQ(image.mips.size(), 3U);
    EXPECT_EQ(image.mips[0].size(), 64U);
    EXPECT_EQ(image.mips[0][1], std::byte{255});
    EXPECT_EQ(image.mips[2], froxel::test::bytesOf({90, 90, 90, 128}));
    EXPECT_THAT(scene.warnings, testing::IsEmpty()) << "told by its first bytes alone";
}

// With the PNG of image 0 and the KTX2 of image 1.
SceneFile withBasisAndPng(const Bytes& ktx2) {
    SceneFile file = withImages(2);
    file.useExtension("KHR_texture_basisu");
    file.json["images"][0]["bufferView"] = file.addView(plainPng(1, 2, 3));
    file.json["images"][1] = {{"bufferView", file.addView(ktx2)}, {"mimeType", "image/ktx2"}};
    file.json["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 1;
    file.json["materials"][0].erase("occlusionTexture");
    return file;
}

TEST(Images, Ktx2OfTheExtension_WinsOverTheFallback) {
    const scene::Scene scene =
        loaded(withBasisAndPng(froxel::test::ktx2File(froxel::test::uastcLevels())).load());
    ASSERT_EQ(scene.images.size(), 1U) << "the fallback is not read";
    EXPECT_EQ(scene.images[0].width_px, 8U);
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
}

TEST(Images, BrokenKtx2_LeavesItsPlaceToTheFallback) {
    Bytes ktx2 = froxel::test::ktx2File(froxel::test::uastcLevels());
    ktx2.resize(ktx2.size() - 1);
    const scene::Scene scene = loaded(withBasisAndPng(ktx2).load());
    EXPECT_EQ(scene.images.at(0).rgba8[2], std::byte{3});
    EXPECT_TRUE(scene.images.at(0).mips.empty());
    EXPECT_NE(scene.materials.at(0).emissive_texture.texture, scene::kNone);
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(AllOf(HasSubstr("IMAGE_DATA_INVALID at /images/1"),
                                  HasSubstr("image 1 is a broken KTX2 file: level 3 has 16 bytes"),
                                  HasSubstr("; image 0 takes its place"))));
}

// Its header and its index are right; its code books are not.
TEST(Images, Ktx2WithBrokenTexels_LeavesItsPlaceToTheFallback) {
    Bytes ktx2 = froxel::test::etc1sFile();
    uint64_t books_at = 0;
    std::memcpy(&books_at, &ktx2.at(froxel::test::kKtx2GlobalDataAt), sizeof books_at);
    std::fill_n(&ktx2.at(books_at), 60, std::byte{0xFF});
    const scene::Scene scene = loaded(withBasisAndPng(ktx2).load());
    EXPECT_EQ(scene.images.at(0).rgba8[2], std::byte{3});
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("image 1 is a broken KTX2 file: ")));
}

TEST(Images, BrokenKtx2WithoutFallback_LeavesItsTexturesOut) {
    Bytes ktx2 = froxel::test::ktx2File(froxel::test::uastcLevels());
    EXPECT_THAT(leftOut(withImage(Bytes(ktx2.begin(), ktx2.begin() + 60))),
                HasSubstr("image 0 is a broken KTX2 file: it is cut off after 60 bytes"));
    ktx2.at(froxel::test::kKtx2FacesAt) = std::byte{6};
    EXPECT_THAT(leftOut(withImage(ktx2)),
                AllOf(HasSubstr("IMAGE_UNRECOGNIZED_FORMAT at /images/0"),
                      HasSubstr("it has 6 faces; expected 1; its textures are left out")));
}

TEST(Images, Ktx2SideTooLong_IsRefusedByItsHeader) {
    Bytes ktx2 = froxel::test::etc1sFile();
    for (const size_t at : {froxel::test::kKtx2WidthAt, froxel::test::kKtx2WidthAt + 4}) {
        ktx2.at(at) = std::byte{0};
        ktx2.at(at + 1) = std::byte{0x80};
    }
    EXPECT_THAT(failure(withImage(ktx2).load()),
                HasSubstr("image 0 has 32768x32768 pixels; a side may have 1 to 16384"));
}

TEST(Images, SideTooLong_IsRefusedByItsHeader) {
    EXPECT_THAT(failure(withImage(pngClaiming(17'000, 1)).load()),
                HasSubstr("image 0 has 17000x1 pixels; a side may have 1 to 16384"));
}

TEST(Images, MorePixelsThanTheirBytesCanHold_AreABrokenImage) {
    EXPECT_THAT(test::told(withImage(pngClaiming(16384, 16384)).load()),
                HasSubstr("bytes cannot hold the 16384x16384 pixels that its header tells; its "
                          "textures are left out"));
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
    Bytes png = pngClaiming(16384, 16384);
    png.resize(size_t{16384} * 16384 * 4 / 1032 + 1); // so many might hold that
    const int view = file.addView(png);
    for (Json& image : file.json["images"]) {
        image["bufferView"] = view;
    }
    EXPECT_THAT(failure(file.load()), HasSubstr("needs 1073741824 bytes of decoded images"));
}

TEST(Images, EveryBrokenOne_IsNamedAndTheOthersStay) {
    SceneFile file = withImages(3);
    Bytes broken = plainPng(1, 2, 3);
    broken.at(45) ^= std::byte{0xFF};
    file.json["images"][0]["bufferView"] = file.addView(plainPng(1, 2, 3));
    file.json["images"][1]["bufferView"] = file.addView(broken);
    file.json["images"][2]["bufferView"] = file.addView(broken);
    const scene::Scene scene = loaded(file.load());
    // Slots are met in the order normal, occlusion, emissive.
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("image 2 "), HasSubstr("image 1 ")));
    EXPECT_NE(scene.materials.at(0).emissive_texture.texture, scene::kNone);
    EXPECT_EQ(scene.materials.at(0).occlusion_texture.texture, scene::kNone);
    EXPECT_EQ(scene.materials.at(0).normal_texture.texture, scene::kNone);
}

} // namespace
} // namespace froxel::gltf
