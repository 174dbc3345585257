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

} // namespace froxel::test
