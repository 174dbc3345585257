#include "ktx2/reader.h"
#include "unit/ktx2/ktx2_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <gmock/gmock.h>
#include <string>
#include <zlib.h>
#include <zstd.h>

namespace froxel::ktx2 {
namespace {

using test::bytesOf;
using test::etc1sFile;
using test::ktx2File;
using test::Ktx2Spec;
using test::uastcBlock;
using test::uastcLevels;
using testing::HasSubstr;

using Bytes = std::vector<std::byte>;

struct Read {
    std::vector<Bytes> levels;
    std::string failure; // then there are no levels
};

Read readAll(const Bytes& file) {
    constexpr uint32_t kMaxSide_px = 4096; // whoever reads a file chooses the sizes that it takes
    const auto size = readSize(file);
    if (!size) {
        return {{}, size.error().message};
    }
    if (size->width_px > kMaxSide_px || size->height_px > kMaxSide_px) {
        return {{}, "too large"};
    }
    Read out;
    for (uint32_t i = 0; i < size->level_count; ++i) {
        out.levels.emplace_back(size_t{4} * std::max(1U, size->width_px >> i) *
                                std::max(1U, size->height_px >> i));
    }
    const std::vector<std::span<std::byte>> levels(out.levels.begin(), out.levels.end());
    const auto read = readPixels(file, levels);
    return read ? out : Read{{}, read.error().message};
}

std::vector<Bytes> pixelsOf(const Bytes& file) {
    return readAll(file).levels;
}

std::string failureOf(const Bytes& file) {
    return readAll(file).failure;
}

template <class T>
Bytes with(Bytes file, size_t at, T value) {
    std::memcpy(file.data() + at, &value, sizeof value);
    return file;
}

Bytes zstandard(const Bytes& bytes) {
    Bytes packed(ZSTD_compressBound(bytes.size()));
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
    return packed;
}

Bytes zlib(const Bytes& bytes) {
    uLongf size = compressBound(bytes.size());
    Bytes packed(size);
    EXPECT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                       reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
              Z_OK);
    packed.resize(size);
    return packed;
}

// With its levels packed.
template <class Pack>
Ktx2Spec packed(Ktx2Spec spec, uint32_t scheme, Pack pack) {
    spec.scheme = scheme;
    for (Bytes& level : spec.levels) {
        spec.unpacked_bytes.push_back(level.size());
        level = pack(level);
    }
    return spec;
}

// 2x2 and 1x1.
Ktx2Spec rgba8() {
    return {.width_px = 2,
            .height_px = 2,
            .levels = {bytesOf({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}),
                       bytesOf({20, 21, 22, 23})}};
}

Ktx2Spec rgb8() {
    return {.vk_format = 29,
            .width_px = 3,
            .height_px = 1,
            .levels = {bytesOf({1, 2, 3, 4, 5, 6, 7, 8, 9}), bytesOf({10, 11, 12})}};
}

TEST(Ktx2Reader, Rgba8_HasTheTexelsOfEveryLevel) {
    const Ktx2Spec spec = rgba8();
    const Bytes file = ktx2File(spec);
    EXPECT_TRUE(isKtx2(file));
    EXPECT_EQ(readSize(file)->level_count, 2U);
    EXPECT_EQ(pixelsOf(file), spec.levels);
}

TEST(Ktx2Reader, Rgb8_IsOpaque) {
    EXPECT_EQ(pixelsOf(ktx2File(rgb8())),
              (std::vector<Bytes>{bytesOf({1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255}),
                                  bytesOf({10, 11, 12, 255})}));
}

TEST(Ktx2Reader, PackedLevels_AreThoseBefore) {
    EXPECT_EQ(pixelsOf(ktx2File(packed(rgba8(), 2, zstandard))), rgba8().levels);
    EXPECT_EQ(pixelsOf(ktx2File(packed(rgba8(), 3, zlib))), rgba8().levels);
    EXPECT_EQ(pixelsOf(ktx2File(packed(rgb8(), 2, zstandard))), pixelsOf(ktx2File(rgb8())));
}

// As when whoever reads the file is to make the levels.
TEST(Ktx2Reader, NoLevels_AreOne) {
    const Bytes file = with(ktx2File(rgba8()), test::kKtx2LevelsAt, 0U);
    EXPECT_EQ(pixelsOf(file), std::vector<Bytes>{rgba8().levels[0]});
}

// The colours stand in the blocks as they are.
TEST(Ktx2Reader, Uastc_HasTheColoursOfItsBlocks) {
    const auto pixels = pixelsOf(ktx2File(uastcLevels()));
    ASSERT_EQ(pixels.size(), 4U);
    const std::vector<Bytes> colors = {bytesOf({255, 0, 0, 255}), bytesOf({0, 255, 0, 255}),
                                       bytesOf({0, 0, 255, 255}), bytesOf({90, 90, 90, 128})};
    for (size_t i = 0; i < pixels.size(); ++i) {
        for (size_t k = 0; k < pixels[i].size(); ++k) {
            ASSERT_EQ(pixels[i][k], colors[i][k % 4]) << "level " << i << " byte " << k;
        }
    }
    EXPECT_EQ(pixelsOf(ktx2File(packed(uastcLevels(), 2, zstandard))), pixels);
}

// Rows of blocks lie one after the other; the last ones are cut.
TEST(Ktx2Reader, UastcOfOddSides_PlacesBlocksByRows) {
    Ktx2Spec spec = uastcLevels();
    spec.width_px = 6;
    spec.height_px = 5;
    Bytes blocks;
    for (const uint8_t shade : std::array<uint8_t, 4>{10, 20, 30, 40}) {
        const Bytes block = uastcBlock(shade, 0, 0, 255);
        blocks.insert(blocks.end(), block.begin(), block.end());
    }
    spec.levels = {blocks};
    const auto pixels = pixelsOf(ktx2File(spec));
    ASSERT_EQ(pixels.size(), 1U);
    for (size_t y = 0; y < 5; ++y) {
        for (size_t x = 0; x < 6; ++x) {
            const size_t block = x / 4 + y / 4 * 2;
            EXPECT_EQ(std::to_integer<size_t>(pixels[0][4 * (y * 6 + x)]), 10 * (block + 1));
        }
    }
}

// ETC1S has five bits a channel and steps of two at least.
TEST(Ktx2Reader, Etc1s_HasItsColoursWithinItsSteps) {
    const auto pixels = pixelsOf(etc1sFile());
    ASSERT_EQ(pixels.size(), 5U);
    for (size_t y = 0; y < 8; ++y) {
        for (size_t x = 0; x < 16; ++x) {
            const std::byte* texel = &pixels[0][4 * (16 * y + x)];
            EXPECT_NEAR(std::to_integer<int>(texel[0]), x < 8 ? 200 : 40, 6);
            EXPECT_NEAR(std::to_integer<int>(texel[1]), 40, 6);
            EXPECT_NEAR(std::to_integer<int>(texel[2]), x < 8 ? 40 : 200, 6);
            EXPECT_EQ(texel[3], std::byte{255});
        }
    }
}

TEST(Ktx2Reader, OtherKinds_AreRefusedByName) {
    const Bytes file = ktx2File(rgba8());
    EXPECT_THAT(failureOf(with(file, test::kKtx2DepthAt, 4U)),
                HasSubstr("it has the depth 4; expected 0"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2LayersAt, 3U)),
                HasSubstr("it is an array of 3 pictures; expected one"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2FacesAt, 6U)), HasSubstr("6 faces; expected 1"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2VkFormatAt, 145U)),
                HasSubstr("its vkFormat is 145; expected 0 (ETC1S, UASTC)"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2VkFormatAt, 0U)),
                HasSubstr("the colour model 1; expected ETC1S (163), UASTC (166)"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2SchemeAt, 1U)),
                HasSubstr("its supercompressionScheme is 1; right of 8 bits a channel is 0, 2"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2SchemeAt, 258U)),
                HasSubstr("supercompressionScheme is 258"));
    Ktx2Spec two_channels = uastcLevels();
    two_channels.channel = 5;
    EXPECT_THAT(failureOf(ktx2File(two_channels)),
                HasSubstr("its channels are 5 of the colour model 166; expected RGB or RGBA"));
    EXPECT_THAT(failureOf(with(etc1sFile(), test::kKtx2SchemeAt, 0U)),
                HasSubstr("right of ETC1S is 1 (BasisLZ)"));
}

TEST(Ktx2Reader, WrongSizes_AreRefused) {
    const Bytes file = ktx2File(rgba8());
    EXPECT_THAT(failureOf(with(file, test::kKtx2WidthAt, 0U)), HasSubstr("it has 0x2 pixels"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2WidthAt, 0xffffffffU)),
                HasSubstr("it has 4294967295x2 pixels; a side may have 1 to 1073741824"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2WidthAt, 3U)),
                HasSubstr("level 0 has 16 bytes of texels; expected 24"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2LevelsAt, 3U)),
                HasSubstr("it has 3 levels; 2x2 pixels have at most 2"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2IndexAt, uint64_t{1} << 40U)),
                HasSubstr("level 0 has 16 bytes from byte 1099511627776 on; the file has 192"));
    EXPECT_THAT(failureOf(with(file, test::kKtx2IndexAt + 32, ~uint64_t{0})),
                HasSubstr("level 1 has 18446744073709551615 bytes from"));
    EXPECT_THAT(failureOf(with(ktx2File(uastcLevels()), test::kKtx2DescriptorAt, 0xffffffffU)),
                HasSubstr("its data format descriptor has 44 bytes from byte 4294967295 on"));
    EXPECT_THAT(failureOf(with(ktx2File(uastcLevels()), test::kKtx2DescriptorAt + 4, 12U)),
                HasSubstr("its data format descriptor has 12 bytes; expected at least 44"));
}

TEST(Ktx2Reader, WrongPacking_IsRefused) {
    for (const auto& [scheme, pack] : {std::pair(2U, &zstandard), std::pair(3U, &zlib)}) {
        Ktx2Spec spec = packed(rgba8(), scheme, pack);
        Ktx2Spec longer = spec;
        longer.unpacked_bytes[0] = 1ULL << 40U;
        EXPECT_THAT(failureOf(ktx2File(longer)),
                    HasSubstr("level 0 has 1099511627776 bytes of texels; expected 16"));
        Ktx2Spec shorter = spec;
        shorter.levels[1] = pack(bytesOf({1, 2, 3}));
        EXPECT_THAT(failureOf(ktx2File(shorter)),
                    HasSubstr("level 1 cannot be unpacked: it ends too soon"));
        Ktx2Spec more = spec;
        more.levels[1] = pack(bytesOf({1, 2, 3, 4, 5}));
        EXPECT_THAT(failureOf(ktx2File(more)), HasSubstr("level 1 cannot be unpacked: "));
        spec.levels[0] = bytesOf({1, 2, 3, 4});
        EXPECT_THAT(failureOf(ktx2File(spec)), HasSubstr("level 0 cannot be unpacked: "));
    }
}

TEST(Ktx2Reader, CutOffAnywhere_IsRefused) {
    for (const Bytes& file : {ktx2File(rgba8()), ktx2File(uastcLevels()),
                              ktx2File(packed(rgb8(), 2, zstandard)), etc1sFile()}) {
        for (size_t size = 0; size < file.size(); ++size) {
            EXPECT_NE(failureOf(Bytes(file.begin(), file.begin() + std::ptrdiff_t(size))), "")
                << size << " of " << file.size();
        }
    }
}

// Whatever it then holds is a picture or one line.
TEST(Ktx2Reader, DamagedBytes_NeitherCrashNorStopOthers) {
    const Bytes good = etc1sFile();
    const auto right = pixelsOf(good);
    for (size_t i = 12; i < good.size(); i += 11) {
        Bytes file = good;
        file[i] ^= std::byte{0xFF};
        EXPECT_EQ(failureOf(file).find('\n'), std::string::npos);
    }
    EXPECT_EQ(pixelsOf(good), right);
}

TEST(Ktx2Reader, OtherRoom_IsRefused) {
    const Bytes file = ktx2File(rgba8());
    Bytes pixels(16);
    const std::vector<std::span<std::byte>> one{pixels};
    EXPECT_EQ(readPixels(file, one).error().code, ErrorCode::kInvalidArgument);
    const std::vector<std::span<std::byte>> wrong{pixels, pixels};
    EXPECT_EQ(readPixels(file, wrong).error().code, ErrorCode::kInvalidArgument);
}

} // namespace
} // namespace froxel::ktx2
