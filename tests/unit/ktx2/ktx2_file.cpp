#include "unit/ktx2/ktx2_file.h"

#include <cstring>

namespace froxel::test {
namespace {

class Writer {
  public:
    template <class T>
    void add(T value) {
        const auto* first = reinterpret_cast<const std::byte*>(&value);
        bytes.insert(bytes.end(), first, first + sizeof value);
    }
    void add(const std::vector<std::byte>& more) {
        bytes.insert(bytes.end(), more.begin(), more.end());
    }

    std::vector<std::byte> bytes;
};

constexpr uint32_t kDescriptorBytes = 44;

// One basic block with one sample.
std::vector<std::byte> descriptor(const Ktx2Spec& spec) {
    Writer out;
    out.add(kDescriptorBytes);
    out.add(uint32_t{0}); // vendor and type
    out.add(uint16_t{2}); // version
    out.add(uint16_t{kDescriptorBytes - 4});
    out.add(bytesOf({spec.color_model, 1, 2, 0})); // BT.709, sRGB, straight alpha
    out.add(bytesOf({3, 3, 0, 0}));                // blocks of 4x4
    out.add(uint64_t{16});                         // bytes a block
    out.add(uint16_t{0});                          // the sample's first bit
    out.add(bytesOf({127, spec.channel}));
    out.add(uint64_t{0xffffffff00000000});
    out.add(uint32_t{0});
    return out.bytes;
}

} // namespace

std::vector<std::byte> bytesOf(const std::vector<int>& values) {
    std::vector<std::byte> bytes;
    for (const int value : values) {
        bytes.push_back(static_cast<std::byte>(value));
    }
    return bytes;
}

std::vector<std::byte> ktx2File(const Ktx2Spec& spec) {
    Writer out;
    out.add(bytesOf({0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'}));
    const auto level_count = static_cast<uint32_t>(spec.levels.size());
    for (const uint32_t field : {spec.vk_format, 1U, spec.width_px, spec.height_px, 0U, 0U, 1U,
                                 level_count, spec.scheme}) {
        out.add(field);
    }
    const auto descriptor_at = static_cast<uint32_t>(kKtx2IndexAt + 24 * spec.levels.size());
    out.add(descriptor_at);
    out.add(kDescriptorBytes);
    out.add(uint64_t{0}); // no keys and values
    out.add(uint64_t{0}); // no global data
    out.add(uint64_t{0});
    uint64_t at = descriptor_at + kDescriptorBytes;
    for (size_t i = 0; i < spec.levels.size(); ++i) {
        const uint64_t size = spec.levels[i].size();
        out.add(at);
        out.add(size);
        out.add(spec.unpacked_bytes.empty() ? size : spec.unpacked_bytes[i]);
        at += size;
    }
    out.add(descriptor(spec));
    for (const auto& level : spec.levels) {
        out.add(level);
    }
    return out.bytes;
}

std::vector<std::byte> uastcBlock(uint8_t red, uint8_t green, uint8_t blue, uint8_t alpha) {
    uint64_t bits = 0x17; // the mode, in five bits
    uint32_t at = 5;
    for (const uint8_t channel : {red, green, blue, alpha}) {
        bits |= uint64_t{channel} << at;
        at += 8;
    }
    Writer out;
    out.add(bits);
    out.add(uint64_t{0}); // hints for other formats
    return out.bytes;
}

Ktx2Spec uastcLevels() {
    Ktx2Spec spec{.vk_format = 0, .width_px = 8, .height_px = 8};
    spec.color_model = 166;
    spec.channel = 3; // RGBA
    Writer four;
    for (int i = 0; i < 4; ++i) {
        four.add(uastcBlock(255, 0, 0, 255));
    }
    spec.levels = {four.bytes, uastcBlock(0, 255, 0, 255), uastcBlock(0, 0, 255, 255),
                   uastcBlock(90, 90, 90, 128)};
    return spec;
}

std::vector<std::byte> etc1sFile() {
    constexpr size_t kBytes = 542;
    constexpr uint64_t kWords[] = {
        0xbb30322058544bab, 0x000000000a1a0a0d, 0x0000001000000001, 0x0000000000000008,
        0x0000000100000000, 0x0000000100000005, 0x0000002c000000c8, 0x00000024000000f4,
        0x0000000000000118, 0x00000000000000fd, 0x000000000000021a, 0x0000000000000004,
        0x0000000000000000, 0x0000000000000218, 0x0000000000000002, 0x0000000000000000,
        0x0000000000000217, 0x0000000000000001, 0x0000000000000000, 0x0000000000000216,
        0x0000000000000001, 0x0000000000000000, 0x0000000000000215, 0x0000000000000001,
        0x0000000000000000, 0x000000000000002c, 0x000201a300280002, 0x0000000800000303,
        0x003f000000000000, 0x0000000000000000, 0x0000001fffffffff, 0x657469727758544b,
        0x2073697361420072, 0x6173726576696e55, 0x000030352e32206c, 0x0000003b00060007,
        0x0000003100000019, 0x0000000000000000, 0x0000000400000000, 0x0000000000000000,
        0x0000000000000000, 0x0000000000000002, 0x0000000000000000, 0x0000000100000000,
        0x0000000000000000, 0x0000000000000000, 0x0000000000000001, 0x0000000000000000,
        0x0000000100000000, 0x0000000000000000, 0x4100000180144020, 0x440200c83626add8,
        0x588184000000100d, 0x1809c401964d607c, 0x085e601480000000, 0x10000000010014c0,
        0x9faa172c58351d14, 0xa800000004076549, 0xb2b2b2b2b2aaaaaa, 0xfad2d2d2d4b4b4b4,
        0x0044c10007ffffff, 0xbfe1120000000000, 0x00000040011001d5, 0x0061b53009f16408,
        0x6489578580004000, 0x0000000009800204, 0xd79f1d0010040000, 0x000005b9e202028b};
    std::vector<std::byte> bytes(kBytes);
    std::memcpy(bytes.data(), kWords, kBytes);
    return bytes;
}

} // namespace froxel::test
