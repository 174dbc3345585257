#include "gltf_writer/png_image.h"

#include <png.h>

#include <cstdio>
#include <new>
#include <string>

namespace froxel::gltf_writer {
namespace {

constexpr size_t kChannels = 4;

bool isOpaque(const scene::Image& image) {
    for (size_t i = 3; i < image.rgba8.size(); i += kChannels) {
        if (image.rgba8[i] != std::byte{255}) {
            return false;
        }
    }
    return true;
}

// What libpng's callbacks see. They are called from C, so nothing may be thrown through them.
struct Sink {
    std::vector<std::byte>* bytes;
    char reason[96];
};

void fail(png_structp png, png_const_charp text) {
    auto* sink = static_cast<Sink*>(png_get_error_ptr(png));
    std::snprintf(sink->reason, sizeof sink->reason, "%s", text);
    png_longjmp(png, 1);
}

void ignore(png_structp /*png*/, png_const_charp /*text*/) {}

void append(png_structp png, png_bytep data, size_t size) {
    auto* sink = static_cast<Sink*>(png_get_io_ptr(png));
    bool stored = true;
    try {
        const auto* first = reinterpret_cast<const std::byte*>(data);
        sink->bytes->insert(sink->bytes->end(), first, first + size);
    } catch (const std::bad_alloc&) {
        stored = false;
    }
    if (!stored) {
        png_error(png, "out of memory");
    }
}

// The part that libpng may leave by longjmp: no object with a destructor lives in it.
bool writeImage(png_structp png, png_infop info, Sink* sink, const scene::Image* image, bool rgb) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_set_write_fn(png, sink, append, nullptr);
    png_set_IHDR(png, info, image->width_px, image->height_px, 8,
                 rgb ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    if (rgb) {
        png_set_filler(png, 0, PNG_FILLER_AFTER); // the rows have a fourth byte to skip
    }
    for (size_t y = 0; y < image->height_px; ++y) {
        png_write_row(png, reinterpret_cast<png_const_bytep>(image->rgba8.data()) +
                               y * image->width_px * kChannels);
    }
    png_write_end(png, info);
    return true;
}

} // namespace

Result<std::vector<std::byte>> encodePng(const scene::Image& image) {
    const size_t expected = size_t{image.width_px} * image.height_px * kChannels;
    if (expected == 0 || image.rgba8.size() != expected) {
        return Error{ErrorCode::kScene,
                     "image '" + image.name + "' has " + std::to_string(image.rgba8.size()) +
                         " bytes; " + std::to_string(image.width_px) + "x" +
                         std::to_string(image.height_px) + " RGBA8 pixels need " +
                         std::to_string(expected) + ", more than 0"};
    }
    std::vector<std::byte> bytes;
    Sink sink{&bytes, {}};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, fail, ignore);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool written = info != nullptr && writeImage(png, info, &sink, &image, isOpaque(image));
    png_destroy_write_struct(&png, &info);
    if (!written) {
        return Error{ErrorCode::kScene,
                     "image '" + image.name + "' cannot be encoded as PNG: " +
                         (sink.reason[0] != '\0' ? sink.reason : "out of memory")};
    }
    return bytes;
}

} // namespace froxel::gltf_writer
