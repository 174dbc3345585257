#include "gltf/image_decode.h"

#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/limits.h"
#include "jpeg/reader.h"
#include "ktx2/reader.h"
#include "png/reader.h"

#include <webp/decode.h>

#include <cstring>
#include <vector>

namespace froxel::gltf {
namespace {

bool beginsWith(std::span<const std::byte> file, std::string_view bytes, size_t offset = 0) {
    return file.size() >= offset + bytes.size() &&
           std::memcmp(file.data() + offset, bytes.data(), bytes.size()) == 0;
}

bool isWebp(std::span<const std::byte> file) {
    return beginsWith(file, "RIFF") && beginsWith(file, "WEBP", 8);
}

const unsigned char* data(std::span<const std::byte> file) {
    return reinterpret_cast<const unsigned char*>(file.data());
}

[[noreturn]] void
failBroken(const std::string& user, const char* format, const std::string& reason) {
    throw Unusable(warning::kBrokenImage,
                   user + " is a broken " + format + " file: " + printable(reason));
}

[[noreturn]] void failFormat(std::span<const std::byte> file, const std::string& user) {
    throw Unusable(warning::kImageFormat, user + " is of an unknown format (" +
                                              std::to_string(file.size()) +
                                              " bytes); expected PNG, JPEG, WebP or KTX2");
}

[[noreturn]] void failJpeg(const Error& error, const std::string& user) {
    if (error.code == ErrorCode::kUnsupported) {
        throw Unusable(warning::kImageFormat, user + " " + error.message);
    }
    failBroken(user, "JPEG", error.message);
}

ImageSize jpegSize(std::span<const std::byte> file, const std::string& user) {
    const auto size = jpeg::readSize(file);
    if (!size) {
        failJpeg(size.error(), user);
    }
    return {size->width_px, size->height_px};
}

std::string
decodeJpeg(std::span<const std::byte> file, const std::string& user, scene::Image& image) {
    const auto warning = jpeg::readPixels(file, image.rgba8.writable());
    if (!warning) {
        failJpeg(warning.error(), user);
    }
    return warning->empty() ? "" : user + ": " + *warning;
}

ImageSize webpSize(std::span<const std::byte> file, const std::string& user) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data(file), file.size(), &features) != VP8_STATUS_OK) {
        failBroken(user, "WebP", "its header cannot be read");
    }
    if (features.has_animation != 0) {
        throw Unusable(warning::kImageFormat, user + " is a WebP animation; expected one picture");
    }
    return {static_cast<uint32_t>(features.width), static_cast<uint32_t>(features.height)};
}

void decodeWebp(std::span<const std::byte> file, const std::string& user, scene::Image& image) {
    if (WebPDecodeRGBAInto(data(file), file.size(), reinterpret_cast<uint8_t*>(image.rgba8.data()),
                           image.rgba8.size(), static_cast<int>(image.width_px * 4)) == nullptr) {
        failBroken(user, "WebP", "its picture cannot be decoded");
    }
}

[[noreturn]] void failKtx2(const Error& error, const std::string& user) {
    if (error.code == ErrorCode::kUnsupported) {
        throw Unusable(warning::kImageFormat,
                       user + " is a KTX2 file of a kind that is not read: " + error.message);
    }
    throw Unusable(warning::kBrokenImage, user + " is a broken KTX2 file: " + error.message);
}

ImageSize ktx2Size(std::span<const std::byte> file, const std::string& user) {
    const auto size = ktx2::readSize(file);
    if (!size) {
        failKtx2(size.error(), user);
    }
    return {size->width_px, size->height_px, size->level_count};
}

void decodeKtx2(std::span<const std::byte> file, const std::string& user, scene::Image& image) {
    std::vector<std::span<std::byte>> levels{image.rgba8.writable()};
    for (KeptBytes& level : image.mips) {
        levels.emplace_back(level.writable());
    }
    if (const auto read = ktx2::readPixels(file, levels); !read) {
        failKtx2(read.error(), user);
    }
}

void decodePng(std::span<const std::byte> file, const std::string& user, scene::Image& image) {
    if (const auto read = png::readPixels(file, image.rgba8.writable()); !read) {
        failBroken(user, "PNG", read.error().message);
    }
}

} // namespace

std::string_view imageType(std::span<const std::byte> file) {
    return png::isPng(file)     ? "image/png"
           : jpeg::isJpeg(file) ? "image/jpeg"
           : isWebp(file)       ? "image/webp"
           : ktx2::isKtx2(file) ? "image/ktx2"
                                : "";
}

ImageSize imageSize(std::span<const std::byte> file, const std::string& user) {
    ImageSize size;
    if (png::isPng(file)) {
        const auto told = png::readSize(file);
        if (!told) {
            failBroken(user, "PNG", told.error().message);
        }
        size = {told->width_px, told->height_px};
    } else if (jpeg::isJpeg(file)) {
        size = jpegSize(file, user);
    } else if (isWebp(file)) {
        size = webpSize(file, user);
    } else if (ktx2::isKtx2(file)) {
        size = ktx2Size(file, user);
    } else {
        failFormat(file, user);
    }
    if (size.width_px == 0 || size.height_px == 0 || size.width_px > kMaxImageSide_px ||
        size.height_px > kMaxImageSide_px) {
        fail(user + " has " + std::to_string(size.width_px) + "x" + std::to_string(size.height_px) +
             " pixels; a side may have 1 to " + std::to_string(kMaxImageSide_px));
    }
    return size;
}

std::string decodeImage(std::span<const std::byte> file,
                        const std::string& user,
                        scene::Image& image,
                        const PixelRoom& room) {
    const ImageSize size = imageSize(file, user);
    image.width_px = size.width_px;
    image.height_px = size.height_px;
    image.rgba8 = room(size.levelBytes(0));
    image.mips.resize(size.level_count - 1);
    for (uint32_t level = 1; level < size.level_count; ++level) {
        image.mips[level - 1] = room(size.levelBytes(level));
    }
    if (jpeg::isJpeg(file)) {
        return decodeJpeg(file, user, image);
    }
    if (isWebp(file)) {
        decodeWebp(file, user, image);
    } else if (ktx2::isKtx2(file)) {
        decodeKtx2(file, user, image);
    } else {
        decodePng(file, user, image);
    }
    return "";
}

} // namespace froxel::gltf
