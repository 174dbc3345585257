#include "ktx2/reader.h"

#include "core/text.h"
#include "ktx2/basis_transcoder.h"
#include "ktx2/container.h"

#include <cstring>
#include <string>
#include <vector>
#include <zlib.h>
#include <zstd.h>

namespace froxel::ktx2 {
namespace {

constexpr size_t kChannels = 4;

// Fills `out`, which has the size that the level tells. What is wrong, or nullptr.
const char* unpackZstandard(std::span<const std::byte> packed, std::span<std::byte> out) {
    const size_t size = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
    if (ZSTD_isError(size) != 0) {
        return ZSTD_getErrorName(size);
    }
    return size == out.size() ? nullptr : "it ends too soon";
}

const char* unpackZlib(std::span<const std::byte> packed, std::span<std::byte> out) {
    uLongf size = out.size();
    const int code = uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (code != Z_OK) {
        return zError(code);
    }
    return size == out.size() ? nullptr : "it ends too soon";
}

void addAlpha(std::span<const std::byte> rgb, std::span<std::byte> rgba8) {
    for (size_t i = 0; i < rgb.size() / 3; ++i) {
        std::memcpy(&rgba8[kChannels * i], &rgb[3 * i], 3);
        rgba8[kChannels * i + 3] = std::byte{0xFF};
    }
}

Result<void>
readPlain(const Container& container, const Level& level, size_t number, std::span<std::byte> out) {
    const bool has_alpha = container.texels == Texels::kRgba8;
    std::vector<std::byte> rgb(has_alpha ? 0 : unpackedBytes(container.texels, level));
    std::span<std::byte> texels = has_alpha ? out : std::span(rgb);
    const char* wrong = nullptr;
    switch (container.packing) {
    case Packing::kZstandard:
        wrong = unpackZstandard(level.packed, texels);
        break;
    case Packing::kZlib:
        wrong = unpackZlib(level.packed, texels);
        break;
    case Packing::kNone:
    case Packing::kBasisLz:
        std::memcpy(texels.data(), level.packed.data(), texels.size());
    }
    if (wrong != nullptr) {
        return Error{ErrorCode::kIo,
                     "level " + numberText(number) + " cannot be unpacked: " + printable(wrong)};
    }
    if (!has_alpha) {
        addAlpha(texels, out);
    }
    return {};
}

} // namespace

bool isKtx2(std::span<const std::byte> file) {
    constexpr unsigned char kSignature[] = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                            '0',  0xBB, '\r', '\n', 0x1A, '\n'};
    return file.size() >= sizeof kSignature &&
           std::memcmp(file.data(), kSignature, sizeof kSignature) == 0;
}

Result<Size> readSize(std::span<const std::byte> file) {
    const auto container = readContainer(file);
    if (!container) {
        return container.error();
    }
    return Size{container->levels[0].width_px, container->levels[0].height_px,
                static_cast<uint32_t>(container->levels.size())};
}

Result<void> readPixels(std::span<const std::byte> file,
                        std::span<const std::span<std::byte>> levels) {
    const auto container = readContainer(file);
    if (!container) {
        return container.error();
    }
    if (levels.size() != container->levels.size()) {
        return Error{ErrorCode::kInvalidArgument, "KTX2 of " +
                                                      numberText(container->levels.size()) +
                                                      " levels into " + numberText(levels.size())};
    }
    for (size_t i = 0; i < levels.size(); ++i) {
        const Level& level = container->levels[i];
        if (levels[i].size() != size_t{level.width_px} * level.height_px * kChannels) {
            return Error{ErrorCode::kInvalidArgument, "KTX2's level " + numberText(i) + " into " +
                                                          numberText(levels[i].size()) + " bytes"};
        }
    }
    if (container->texels == Texels::kEtc1s || container->texels == Texels::kUastc) {
        return transcodeBasis(file, levels);
    }
    for (size_t i = 0; i < levels.size(); ++i) {
        if (auto read = readPlain(*container, container->levels[i], i, levels[i]); !read) {
            return read;
        }
    }
    return {};
}

} // namespace froxel::ktx2
