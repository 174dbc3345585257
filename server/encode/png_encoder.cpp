#include "encode/png_encoder.h"

#include "core/text.h"

#include <png.h>

#include <cstdio>
#include <exception>
#include <string>
#include <zlib.h>

namespace froxel::encode {
namespace {

constexpr size_t kPixelBytes = 4;
constexpr size_t kChunkBytes = size_t{64} * 1024; // zlib's output, an IDAT chunk each

// libpng reports through longjmp; this keeps it among plain C frames. Its text goes to `reason`.
struct PngSink {
    std::vector<std::byte>* bytes;
    char reason[96];
};

void pngFail(png_structp png, png_const_charp text) {
    auto* sink = static_cast<PngSink*>(png_get_error_ptr(png));
    std::snprintf(sink->reason, sizeof sink->reason, "%s", text);
    png_longjmp(png, 1);
}

void pngIgnore(png_structp /*png*/, png_const_charp /*warning*/) {}

bool append(std::vector<std::byte>& out, png_bytep data, size_t bytes) noexcept {
    try {
        const auto* from = reinterpret_cast<const std::byte*>(data);
        out.insert(out.end(), from, from + bytes);
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

void pngWrite(png_structp png, png_bytep data, size_t bytes) {
    auto* sink = static_cast<PngSink*>(png_get_io_ptr(png));
    if (!append(*sink->bytes, data, bytes)) {
        png_error(png, "out of memory");
    }
}

void pngFlush(png_structp /*png*/) {}

// No object with a destructor may live in this function: libpng's errors jump out of it.
bool emitPng(png_structp png, png_infop info, PngSink* sink, const PixelView& pixels) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_set_write_fn(png, sink, pngWrite, pngFlush);
    png_set_IHDR(png, info, pixels.width_px, pixels.height_px, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
    png_set_compression_strategy(png, Z_RLE);
    png_set_compression_level(png, 1);
    png_set_compression_buffer_size(png, kChunkBytes);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER); // the view's alpha stays out
    const auto* row = reinterpret_cast<png_const_bytep>(pixels.data);
    for (uint32_t y = 0; y < pixels.height_px; ++y) {
        png_write_row(png, row);
        row += pixels.stride_bytes;
    }
    png_write_end(png, info);
    return true;
}

} // namespace

Result<std::vector<std::byte>> encodePng(const PixelView& pixels) {
    if (pixels.data == nullptr || pixels.width_px == 0 || pixels.height_px == 0 ||
        pixels.stride_bytes < pixels.width_px * kPixelBytes) {
        return Error{ErrorCode::kInvalidArgument,
                     "PNG of " + numberText(pixels.width_px) + "x" + numberText(pixels.height_px) +
                         " pixels in rows of " + numberText(pixels.stride_bytes) + " bytes"};
    }
    std::vector<std::byte> bytes;
    bytes.reserve(size_t{2} * pixels.width_px * pixels.height_px);
    PngSink sink{&bytes, {}};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, pngFail, pngIgnore);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool written = info != nullptr && emitPng(png, info, &sink, pixels);
    png_destroy_write_struct(&png, &info);
    if (!written) {
        return Error{ErrorCode::kIo,
                     sink.reason[0] != '\0' ? std::string(sink.reason) : "libpng cannot start"};
    }
    return bytes;
}

} // namespace froxel::encode
