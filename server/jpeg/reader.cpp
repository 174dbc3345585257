#include "jpeg/reader.h"

#include "core/text.h"

#include <turbojpeg.h>

#include <cstring>
#include <memory>
#include <string_view>

namespace froxel::jpeg {
namespace {

struct DestroyDecompressor {
    void operator()(void* handle) const { tjDestroy(handle); }
};
using Decompressor = std::unique_ptr<void, DestroyDecompressor>;

// A progressive file of a few bytes may have thousands of scans, each over every pixel.
constexpr int kLimitScans = TJFLAG_LIMITSCANS;

const unsigned char* data(std::span<const std::byte> file) {
    return reinterpret_cast<const unsigned char*>(file.data());
}

// After this, `decoder` is ready for the pixels.
Result<PictureSize> sizeOf(const Decompressor& decoder, std::span<const std::byte> file) {
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colorspace = 0;
    if (decoder == nullptr || tjDecompressHeader3(decoder.get(), data(file), file.size(), &width,
                                                  &height, &subsampling, &colorspace) != 0) {
        return Error{ErrorCode::kIo, tjGetErrorStr2(decoder.get())};
    }
    if (width < 1 || height < 1) { // what the library says of a file that ends too soon
        return Error{ErrorCode::kIo, "its header is cut off"};
    }
    // A block of 64 pixels takes a bit at least.
    constexpr uint64_t kPixelsOfByte = 512;
    const PictureSize size{static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
    if (size.pixelCount() > file.size() * kPixelsOfByte) {
        return Error{ErrorCode::kIo, numberText(file.size()) + " bytes cannot hold the " +
                                         numberText(width) + "x" + numberText(height) +
                                         " pixels that its header tells"};
    }
    if (colorspace == TJCS_CMYK || colorspace == TJCS_YCCK) {
        return Error{ErrorCode::kUnsupported, "is a CMYK JPEG; expected RGB or grey"};
    }
    return size;
}

} // namespace

bool isJpeg(std::span<const std::byte> file) {
    constexpr std::string_view kStart = "\xFF\xD8\xFF";
    return file.size() >= kStart.size() &&
           std::memcmp(file.data(), kStart.data(), kStart.size()) == 0;
}

Result<PictureSize> readSize(std::span<const std::byte> file) {
    return sizeOf(Decompressor(tjInitDecompress()), file);
}

Result<std::string> readPixels(std::span<const std::byte> file, std::span<std::byte> rgba8) {
    const Decompressor decoder(tjInitDecompress());
    const auto size = sizeOf(decoder, file);
    if (!size) {
        return size.error();
    }
    if (rgba8.size() != size->pixelCount() * 4) {
        return Error{ErrorCode::kInvalidArgument,
                     "JPEG of " + numberText(size->width_px) + "x" + numberText(size->height_px) +
                         " pixels into " + numberText(rgba8.size()) + " bytes"};
    }
    auto* pixels = reinterpret_cast<unsigned char*>(rgba8.data());
    if (tjDecompress2(decoder.get(), data(file), file.size(), pixels,
                      static_cast<int>(size->width_px), 0, static_cast<int>(size->height_px),
                      TJPF_RGBA, kLimitScans) == 0) {
        return std::string();
    }
    if (tjGetErrorCode(decoder.get()) == TJERR_WARNING) {
        return printable(tjGetErrorStr2(decoder.get()));
    }
    return Error{ErrorCode::kIo, tjGetErrorStr2(decoder.get())};
}

} // namespace froxel::jpeg
