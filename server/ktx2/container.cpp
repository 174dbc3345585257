#include "ktx2/container.h"

#include "core/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>

namespace froxel::ktx2 {
namespace {

// Of Zstandard at best, above zlib's: four bytes for a block of 128 KiB of one value (RFC 8878,
// 3.1.1.2).
constexpr uint64_t kPackingRatio = 32768;

// Section 3 of the specification: where the header's fields lie.
constexpr uint64_t kHeaderBytes = 80;
constexpr uint64_t kIndexEntryBytes = 24;
constexpr size_t kVkFormatAt = 12;
constexpr size_t kWidthAt = 20;
constexpr size_t kHeightAt = 24;
constexpr size_t kDepthAt = 28;
constexpr size_t kLayersAt = 32;
constexpr size_t kFacesAt = 36;
constexpr size_t kLevelsAt = 40;
constexpr size_t kSchemeAt = 44;
constexpr size_t kDescriptorAt = 48;
constexpr size_t kDescriptorBytesAt = 52;

// VkFormat
constexpr uint32_t kUndefined = 0;
constexpr std::array kRgb8Formats = {23U, 29U};
constexpr std::array kRgba8Formats = {37U, 43U};

// Khronos Data Format Specification 1.3: a basic descriptor block after its total size. Colour
// models and channels by its sections 5.6.14 and 5.6.15.
constexpr size_t kModelAt = 12;
constexpr size_t kFirstSampleAt = 28;
constexpr size_t kSampleBytes = 16;
constexpr size_t kChannelAt = 3; // in a sample; the low four bits
constexpr uint32_t kEtc1sModel = 163;
constexpr uint32_t kUastcModel = 166;
constexpr uint32_t kRgbChannel = 0;
constexpr uint32_t kUastcRgbaChannel = 3;
constexpr uint32_t kEtc1sAlphaChannel = 15;

constexpr uint32_t kMaxSide_px = 1U << 30U; // products of two stay in range
constexpr uint32_t kBlockSide = 4;
constexpr uint64_t kUastcBlockBytes = 16;

template <class T>
T numberAt(std::span<const std::byte> bytes, size_t at) {
    static_assert(std::endian::native == std::endian::little, "as the file is");
    T value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

Error broken(const std::string& reason) {
    return {ErrorCode::kIo, reason};
}

Error other(const std::string& what) {
    return {ErrorCode::kUnsupported, what};
}

// The part of the file from `at` on, or nothing where it ends before `size` bytes.
std::optional<std::span<const std::byte>>
part(std::span<const std::byte> file, uint64_t at, uint64_t size) {
    if (at > file.size() || size > file.size() - at) {
        return std::nullopt;
    }
    return file.subspan(at, size);
}

Error outside(const std::string& what, uint64_t at, uint64_t size, size_t file_size) {
    return broken(what + " has " + numberText(size) + " bytes from byte " + numberText(at) +
                  " on; the file has " + numberText(file_size));
}

// One flat picture with no more levels than it can have.
Result<void> checkShape(std::span<const std::byte> file) {
    const auto field = [&](size_t at) { return numberAt<uint32_t>(file, at); };
    if (field(kDepthAt) != 0) {
        return other("it has the depth " + numberText(field(kDepthAt)) +
                     "; expected 0, a flat picture");
    }
    if (field(kLayersAt) > 1) {
        return other("it is an array of " + numberText(field(kLayersAt)) +
                     " pictures; expected one");
    }
    if (field(kFacesAt) != 1) {
        return other("it has " + numberText(field(kFacesAt)) + " faces; expected 1");
    }
    const uint32_t width = field(kWidthAt);
    const uint32_t height = field(kHeightAt);
    if (width == 0 || height == 0 || width > kMaxSide_px || height > kMaxSide_px) {
        return broken("it has " + numberText(width) + "x" + numberText(height) +
                      " pixels; a side may have 1 to " + numberText(kMaxSide_px));
    }
    const auto most = static_cast<uint32_t>(std::bit_width(std::max(width, height)));
    if (field(kLevelsAt) > most) {
        return broken("it has " + numberText(field(kLevelsAt)) + " levels; " + numberText(width) +
                      "x" + numberText(height) + " pixels have at most " + numberText(most));
    }
    return {};
}

// Of texels whose format only the descriptor tells. KHR_texture_basisu allows no other channels.
Result<Texels> basisTexels(std::span<const std::byte> file) {
    const auto at = numberAt<uint32_t>(file, kDescriptorAt);
    const auto size = numberAt<uint32_t>(file, kDescriptorBytesAt);
    const auto descriptor = part(file, at, size);
    if (!descriptor) {
        return outside("its data format descriptor", at, size, file.size());
    }
    if (size < kFirstSampleAt + kSampleBytes) {
        return broken("its data format descriptor has " + numberText(size) +
                      " bytes; expected at least " + numberText(kFirstSampleAt + kSampleBytes));
    }
    const auto channel = [&](size_t sample) {
        const size_t byte = kFirstSampleAt + sample * kSampleBytes + kChannelAt;
        return byte < descriptor->size() ? std::to_integer<uint32_t>((*descriptor)[byte]) & 15U
                                         : kEtc1sAlphaChannel;
    };
    const auto model = std::to_integer<uint32_t>((*descriptor)[kModelAt]);
    const bool is_etc1s = model == kEtc1sModel;
    if (!is_etc1s && model != kUastcModel) {
        return other("its texels have the colour model " + numberText(model) +
                     "; expected ETC1S (163), UASTC (166), or 8 bits a channel");
    }
    if (is_etc1s ? channel(0) != kRgbChannel || channel(1) != kEtc1sAlphaChannel
                 : channel(0) != kRgbChannel && channel(0) != kUastcRgbaChannel) {
        return other("its channels are " + numberText(channel(0)) +
                     (is_etc1s ? " and " + numberText(channel(1)) : std::string()) +
                     " of the colour model " + numberText(model) + "; expected RGB or RGBA");
    }
    return is_etc1s ? Texels::kEtc1s : Texels::kUastc;
}

Result<Texels> readTexels(std::span<const std::byte> file) {
    const auto format = numberAt<uint32_t>(file, kVkFormatAt);
    const auto among = [&](const auto& formats) {
        return std::find(formats.begin(), formats.end(), format) != formats.end();
    };
    if (format == kUndefined) {
        return basisTexels(file);
    }
    if (among(kRgba8Formats)) {
        return Texels::kRgba8;
    }
    if (among(kRgb8Formats)) {
        return Texels::kRgb8;
    }
    return other("its vkFormat is " + numberText(format) +
                 "; expected 0 (ETC1S, UASTC), 23, 29 (RGB8), 37 or 43 (RGBA8)");
}

Result<Packing> readPacking(std::span<const std::byte> file, Texels texels) {
    const auto scheme = numberAt<uint32_t>(file, kSchemeAt);
    const auto packing = static_cast<Packing>(scheme);
    const bool known = scheme <= static_cast<uint32_t>(Packing::kZlib);
    const bool fits = texels == Texels::kEtc1s ? packing == Packing::kBasisLz
                      : texels == Texels::kUastc
                          ? packing == Packing::kNone || packing == Packing::kZstandard
                          : packing != Packing::kBasisLz;
    if (!known || !fits) {
        const char* right = texels == Texels::kEtc1s   ? "ETC1S is 1 (BasisLZ)"
                            : texels == Texels::kUastc ? "UASTC is 0 or 2 (Zstandard)"
                                                       : "8 bits a channel is 0, 2 or 3";
        return other("its supercompressionScheme is " + numberText(scheme) + "; right of " + right);
    }
    return packing;
}

Result<Level> readLevel(std::span<const std::byte> file, uint32_t number, const Container& of) {
    Level level;
    level.width_px = std::max(1U, numberAt<uint32_t>(file, kWidthAt) >> number);
    level.height_px = std::max(1U, numberAt<uint32_t>(file, kHeightAt) >> number);
    const size_t entry = kHeaderBytes + number * kIndexEntryBytes;
    const auto at = numberAt<uint64_t>(file, entry);
    const auto size = numberAt<uint64_t>(file, entry + 8);
    const auto unpacked = numberAt<uint64_t>(file, entry + 16);
    const std::string name = "level " + numberText(number);
    const auto bytes = part(file, at, size);
    if (!bytes) {
        return outside(name, at, size, file.size());
    }
    level.packed = *bytes;
    if (of.texels != Texels::kEtc1s) {
        const uint64_t right = unpackedBytes(of.texels, level);
        const uint64_t told = of.packing == Packing::kNone ? size : unpacked;
        if (told != right) {
            return broken(name + " has " + numberText(told) + " bytes of texels; expected " +
                          numberText(right));
        }
        if (of.packing != Packing::kNone && right > size * kPackingRatio) {
            return broken(name + " has " + numberText(size) + " bytes, which cannot hold the " +
                          numberText(right) + " of its texels");
        }
    }
    return level;
}

} // namespace

uint64_t unpackedBytes(Texels texels, const Level& level) {
    const auto blocks = [](uint32_t side) {
        return (uint64_t{side} + kBlockSide - 1) / kBlockSide;
    };
    if (texels == Texels::kUastc) {
        return blocks(level.width_px) * blocks(level.height_px) * kUastcBlockBytes;
    }
    return uint64_t{level.width_px} * level.height_px * (texels == Texels::kRgb8 ? 3 : 4);
}

Result<Container> readContainer(std::span<const std::byte> file) {
    if (file.size() < kHeaderBytes + kIndexEntryBytes) {
        return broken("it is cut off after " + numberText(file.size()) + " bytes; its header has " +
                      numberText(kHeaderBytes + kIndexEntryBytes));
    }
    if (const auto shape = checkShape(file); !shape) {
        return shape.error();
    }
    const auto texels = readTexels(file);
    if (!texels) {
        return texels.error();
    }
    const auto packing = readPacking(file, *texels);
    if (!packing) {
        return packing.error();
    }
    // 0 asks whoever reads the file to make the others, as 1 does in glTF.
    const uint32_t level_count = std::max(1U, numberAt<uint32_t>(file, kLevelsAt));
    const uint64_t index_end = kHeaderBytes + level_count * kIndexEntryBytes;
    if (file.size() < index_end) {
        return broken("it is cut off after " + numberText(file.size()) +
                      " bytes; its level index " + "ends at " + numberText(index_end));
    }
    Container container{*texels, *packing, {}};
    for (uint32_t i = 0; i < level_count; ++i) {
        const auto level = readLevel(file, i, container);
        if (!level) {
            return level.error();
        }
        container.levels.push_back(*level);
    }
    return container;
}

} // namespace froxel::ktx2
