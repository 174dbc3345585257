#include "encode/image_file.h"
#include "encode/radiance_encoder.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <limits>
#include <unistd.h>

namespace froxel::encode {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ImageFile : public ::testing::Test {
  protected:
    ImageFile() {
        std::string name = (fs::temp_directory_path() / "froxel_image_XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~ImageFile() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }
    static std::string contents(const fs::path& path) {
        std::ifstream stream(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

  private:
    fs::path folder_;
};

TEST_F(ImageFile, Extension_DecidesTheFormatInAnyCase) {
    EXPECT_EQ(*imageFormatOf("a.png"), ImageFormat::kPng);
    EXPECT_EQ(*imageFormatOf("a.b/c.JPG"), ImageFormat::kJpeg);
    EXPECT_EQ(*imageFormatOf("a.jpeg"), ImageFormat::kJpeg);
    EXPECT_EQ(*imageFormatOf("a.exr"), ImageFormat::kExr);
    EXPECT_EQ(*imageFormatOf("a.pfm"), ImageFormat::kPfm);
    EXPECT_EQ(imageFormatOf("shot.bmp").error().message,
              "shot.bmp: the name must end in .png, .jpg, .jpeg, .exr or .pfm");
    EXPECT_FALSE(imageFormatOf("png"));
}

TEST_F(ImageFile, Png_ReadsBackBitForBit) {
    for (const auto& [width, height, padding] : {std::tuple{1U, 1U, 0U}, {37U, 21U, 5U}}) {
        const Picture picture = makePicture(width, height, padding);
        const fs::path path = file("round.png");
        ASSERT_TRUE(writeImage(path, picture.view(), {}));
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        ASSERT_TRUE(png_image_begin_read_from_file(&image, path.c_str()));
        EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
        image.format = PNG_FORMAT_RGB;
        ASSERT_EQ(image.width, width);
        ASSERT_EQ(image.height, height);
        std::vector<unsigned char> rgb(PNG_IMAGE_SIZE(image));
        ASSERT_TRUE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr));
        for (uint32_t i = 0; i < width * height * 3; ++i) {
            const uint32_t pixel = i / 3;
            ASSERT_EQ(int{rgb[i]}, picture.channel(pixel % width, pixel / width, i % 3)) << i;
        }
    }
}

TEST_F(ImageFile, Jpeg_IsAJpeg) {
    const Picture picture = makePicture(20, 10);
    ASSERT_TRUE(writeImage(file("a.jpg"), picture.view(), {}));
    EXPECT_THAT(contents(file("a.jpg")), StartsWith("\xff\xd8\xff"));
}

TEST_F(ImageFile, Pfm_HoldsRowsBottomUpBitForBit) {
    const std::vector<float> rgb = {1.0F,  2.0F,   3.0F,     4.0F,
                                    5.0F,  6.0F, // top row
                                    -0.0F, 1e-40F, 65504.0F, std::numeric_limits<float>::infinity(),
                                    0.1F,  3e38F};
    ASSERT_TRUE(writeRadiance(file("a.pfm"), LinearImage{2, 2, rgb}));
    const std::string bytes = contents(file("a.pfm"));
    const std::string header = "PF\n2 2\n-1.0\n";
    ASSERT_EQ(bytes.size(), header.size() + rgb.size() * sizeof(float));
    EXPECT_THAT(bytes, StartsWith(header));
    EXPECT_EQ(std::memcmp(bytes.data() + header.size(), rgb.data() + 6, 24), 0);
    EXPECT_EQ(std::memcmp(bytes.data() + header.size() + 24, rgb.data(), 24), 0);
}

TEST_F(ImageFile, Exr_IsThatOfTheEncoder) {
    const LinearImage image{2, 1, {1, 2, 3, 4, 5, 6}};
    ASSERT_TRUE(writeRadiance(file("a.exr"), image));
    const std::string bytes = contents(file("a.exr"));
    const auto expected = exrOf(image).value();
    ASSERT_EQ(bytes.size(), expected.size());
    EXPECT_EQ(std::memcmp(bytes.data(), expected.data(), bytes.size()), 0);
}

TEST_F(ImageFile, WrongUse_NamesTheFile) {
    const Picture picture = makePicture(4, 4);
    const std::vector<float> rgb(48);
    EXPECT_THAT(writeImage(file("a.pfm"), picture.view(), {}).error().message, HasSubstr("a.pfm"));
    EXPECT_THAT(writeRadiance(file("a.png"), LinearImage{4, 4, rgb}).error().message,
                HasSubstr("a.png"));
    EXPECT_THAT(writeRadiance(file("b.pfm"), LinearImage{4, 5, rgb}).error().message,
                HasSubstr("b.pfm: 48 values do not make 4x5 pixels"));
    EXPECT_THAT(writeImage(file("c.png"), {}, {}).error().message, HasSubstr("c.png"));
    EXPECT_THAT(
        writeImage(file("d.jpg"), picture.view(), {0, settings::Chroma::k420}).error().message,
        HasSubstr("d.jpg: JPEG quality is 0"));
    EXPECT_FALSE(fs::exists(file("b.pfm")) || fs::exists(file("c.png")) ||
                 fs::exists(file("d.jpg")));
}

TEST_F(ImageFile, UnwritablePlace_IsAnIoErrorWithTheReason) {
    const Picture picture = makePicture(4, 4);
    for (const char* name : {"a.png", "a.jpg"}) {
        const auto result = writeImage(file("missing") / name, picture.view(), {});
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        EXPECT_THAT(result.error().message, HasSubstr("No such file or directory"));
    }
}

TEST_F(ImageFile, FullDevice_IsAnIoError) {
    if (access("/dev/full", W_OK) != 0) {
        GTEST_SKIP() << "no /dev/full here";
    }
    const Picture picture = makePicture(300, 300);
    for (const char* name : {"full.png", "full.jpg", "full.exr", "full.pfm"}) {
        fs::create_symlink("/dev/full", file(name));
        const std::vector<float> rgb(size_t{300} * 300 * 3);
        const auto result = !outputsOf(imageFormatOf(name).value()).none()
                                ? writeRadiance(file(name), LinearImage{300, 300, rgb})
                                : writeImage(file(name), picture.view(), {});
        ASSERT_FALSE(result) << name;
        EXPECT_THAT(result.error().message, HasSubstr("No space left on device"));
    }
}

} // namespace
} // namespace froxel::encode
