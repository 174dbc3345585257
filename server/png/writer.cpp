#include "png/writer.h"

#include "core/text.h"
#include "png/failure.h"

#include <exception>
#include <zlib.h>

namespace froxel::png {
namespace {

constexpr size_t kPixelBytes = 4;
constexpr size_t kChunkBytes = size_t{64} * 1024; // zlib's output, an IDAT chunk each

bool append(std::vector<std::byte>& out, png_bytep data, size_t bytes) noexcept {
    try {
        const auto* from = reinterpret_cast<const std::byte*>(data);
        out.insert(out.end(), from, from + bytes);
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

void writeBytes(png_structp png, png_bytep data, size_t bytes) {
    if (!append(*static_cast<std::vector<std::byte>*>(png_get_io_ptr(png)), data, bytes)) {
        png_error(png, "out of memory");
    }
}

void flush(png_structp /*png*/) {}

void setCompression(png_structp png, Compression compression) {
    if (compression == Compression::kFast) {
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
        png_set_compression_strategy(png, Z_RLE);
        png_set_compression_level(png, 1);
        png_set_compression_buffer_size(png, kChunkBytes);
    }
}

// No object with a destructor may live in this function: libpng's errors jump out of it.
bool writeFile(png_structp png,
               png_infop info,
               std::vector<std::byte>* file,
               const PixelView& pixels,
               const WriteOptions& options) {
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    const bool rgb = options.channels == Channels::kRgb;
    png_set_write_fn(png, file, writeBytes, flush);
    png_set_IHDR(png, info, pixels.width_px, pixels.height_px, 8,
                 rgb ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (options.srgb) {
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    }
    setCompression(png, options.compression);
    png_write_info(png, info);
    if (rgb) {
        png_set_filler(png, 0, PNG_FILLER_AFTER); // the rows have a fourth byte to skip
    }
    const auto* row = reinterpret_cast<png_const_bytep>(pixels.data);
    for (uint32_t y = 0; y < pixels.height_px; ++y) {
        png_write_row(png, row);
        row += pixels.stride_bytes;
    }
    png_write_end(png, info);
    return true;
}

} // namespace

Result<std::vector<std::byte>> write(const PixelView& pixels, const WriteOptions& options) {
    if (pixels.data == nullptr || pixels.width_px == 0 || pixels.height_px == 0 ||
        pixels.stride_bytes < pixels.width_px * kPixelBytes) {
        return Error{ErrorCode::kInvalidArgument,
                     "PNG of " + numberText(pixels.width_px) + "x" + numberText(pixels.height_px) +
                         " pixels in rows of " + numberText(pixels.stride_bytes) + " bytes"};
    }
    std::vector<std::byte> file;
    file.reserve(size_t{2} * pixels.width_px * pixels.height_px);
    Failure failure;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool written = info != nullptr && writeFile(png, info, &file, pixels, options);
    png_destroy_write_struct(&png, &info);
    if (!written) {
        return failure.error();
    }
    return file;
}

} // namespace froxel::png
