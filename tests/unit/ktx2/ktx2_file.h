// KTX2 files made in memory, by the specification.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace froxel::test {

struct Ktx2Spec {
    uint32_t vk_format = 37; // R8G8B8A8_UNORM
    uint32_t width_px = 1;
    uint32_t height_px = 1;
    uint32_t scheme = 0;                          // supercompression
    uint8_t color_model = 1;                      // RGBSDA
    uint8_t channel = 0;                          // of the only sample
    std::vector<std::vector<std::byte>> levels{}; // as the file stores them
    std::vector<uint64_t> unpacked_bytes{};       // of each level; empty: as they are stored
};

// Where fields lie that tests change.
constexpr size_t kKtx2VkFormatAt = 12;
constexpr size_t kKtx2WidthAt = 20;
constexpr size_t kKtx2DepthAt = 28;
constexpr size_t kKtx2LayersAt = 32;
constexpr size_t kKtx2FacesAt = 36;
constexpr size_t kKtx2LevelsAt = 40;
constexpr size_t kKtx2SchemeAt = 44;
constexpr size_t kKtx2DescriptorAt = 48;
constexpr size_t kKtx2GlobalDataAt = 64; // of ETC1S
constexpr size_t kKtx2IndexAt = 80;      // 24 bytes a level: offset, bytes, bytes unpacked

[[nodiscard]] std::vector<std::byte> ktx2File(const Ktx2Spec& spec);

[[nodiscard]] std::vector<std::byte> bytesOf(const std::vector<int>& values);

// UASTC of one colour: mode 8 of the Khronos Data Format Specification 1.3, 23.
[[nodiscard]] std::vector<std::byte>
uastcBlock(uint8_t red, uint8_t green, uint8_t blue, uint8_t alpha);

// 8x8 pixels of UASTC and their three smaller levels, each of one colour: red, green, blue, grey
// of half alpha. Unpacked as the file stores them.
[[nodiscard]] Ktx2Spec uastcLevels();

// 16x8 pixels of ETC1S, as Basis Universal's encoder wrote them: the left half (200, 40, 40), the
// right half (40, 40, 200), and four smaller levels.
[[nodiscard]] std::vector<std::byte> etc1sFile();

} // namespace froxel::test
