#include "gltf/image_decode.h"

#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/limits.h"
#include "png/reader.h"

#include <turbojpeg.h>

#include <memory>

namespace froxel::gltf {
namespace {

struct DestroyDecompressor {
    void operator()(void* handle) const { tjDestroy(handle); }
};
using Decompressor = std::unique_ptr<void, DestroyDecompressor>;

// A progressive file of a few bytes may have thousands of scans, each over every pixel.
constexpr int kLimitScans = TJFLAG_LIMITSCANS;

bool isJpeg(std::span<const std::byte> file) {
    return file.size() >= 3 && file[0] == std::byte{0xFF} && file[1] == std::byte{0xD8} &&
           file[2] == std::byte{0xFF};
}

const unsigned char* data(std::span<const std::byte> file) {
    return reinterpret_cast<const unsigned char*>(file.data());
}

[[noreturn]] void
failBroken(const std::string& user, const char* format, const std::string& reason) {
    fail(user + " is a broken " + format + " file: " + printable(reason));
}

// Reads the header; `decoder` is ready for the pixels afterwards.
ImageSize
jpegSize(const Decompressor& decoder, std::span<const std::byte> file, const std::string& user) {
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colorspace = 0;
    if (decoder == nullptr || tjDecompressHeader3(decoder.get(), data(file), file.size(), &width,
                                                  &height, &subsampling, &colorspace) != 0) {
        failBroken(user, "JPEG", tjGetErrorStr2(decoder.get()));
    }
    if (width < 1 || height < 1) { // what the library says of a file that ends too soon
        failBroken(user, "JPEG", "its header is cut off");
    }
    if (colorspace == TJCS_CMYK || colorspace == TJCS_YCCK) {
        fail(user + " is a CMYK JPEG; right is RGB or grey");
    }
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

std::string
decodeJpeg(std::span<const std::byte> file, const std::string& user, scene::Image& image) {
    const Decompressor decoder(tjInitDecompress());
    const ImageSize size = jpegSize(decoder, file, user);
    auto* pixels = reinterpret_cast<unsigned char*>(image.rgba8.data());
    if (tjDecompress2(decoder.get(), data(file), file.size(), pixels,
                      static_cast<int>(size.width_px), 0, static_cast<int>(size.height_px),
                      TJPF_RGBA, kLimitScans) == 0) {
        return "";
    }
    if (tjGetErrorCode(decoder.get()) == TJERR_WARNING) {
        return user + ": " + printable(tjGetErrorStr2(decoder.get()));
    }
    failBroken(user, "JPEG", tjGetErrorStr2(decoder.get()));
}

} // namespace

ImageSize imageSize(std::span<const std::byte> file, const std::string& user) {
    ImageSize size;
    if (png::isPng(file)) {
        const auto told = png::readSize(file);
        if (!told) {
            failBroken(user, "PNG", told.error().message);
        }
        size = {told->width_px, told->height_px};
    } else if (isJpeg(file)) {
        size = jpegSize(Decompressor(tjInitDecompress()), file, user);
    } else {
        fail(user + " is neither a PNG nor a JPEG file (" + std::to_string(file.size()) +
             " bytes)");
    }
    if (size.width_px == 0 || size.height_px == 0 || size.width_px > kMaxImageSide_px ||
        size.height_px > kMaxImageSide_px) {
        fail(user + " has " + std::to_string(size.width_px) + "x" + std::to_string(size.height_px) +
             " pixels; a side may have 1 to " + std::to_string(kMaxImageSide_px));
    }
    return size;
}

std::string
decodeImage(std::span<const std::byte> file, const std::string& user, scene::Image& image) {
    const ImageSize size = imageSize(file, user);
    image.width_px = size.width_px;
    image.height_px = size.height_px;
    image.rgba8.resize(size.decodedBytes());
    if (isJpeg(file)) {
        return decodeJpeg(file, user, image);
    }
    if (const auto read = png::readPixels(file, image.rgba8); !read) {
        failBroken(user, "PNG", read.error().message);
    }
    return "";
}

} // namespace froxel::gltf
