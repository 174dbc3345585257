#include "gltf/png_reader.h"

#include <png.h>

#include <cstdio>
#include <cstring>
#include <vector>

namespace froxel::gltf {
namespace {

constexpr size_t kSignatureBytes = 8;
constexpr size_t kChannels = 4;

// What libpng's callbacks see. They are called from C, so nothing may be thrown through them.
struct Source {
    std::span<const std::byte> left;
    char reason[96];
};

void onError(png_structp png, png_const_charp text) {
    auto* source = static_cast<Source*>(png_get_error_ptr(png));
    std::snprintf(source->reason, sizeof source->reason, "%s", text);
    png_longjmp(png, 1);
}

void ignore(png_structp /*png*/, png_const_charp /*text*/) {}

void readBytes(png_structp png, png_bytep data, size_t size) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (size > source->left.size()) {
        png_error(png, "the file is cut off");
    }
    std::memcpy(data, source->left.data(), size);
    source->left = source->left.subspan(size);
}

class Reader {
  public:
    explicit Reader(std::span<const std::byte> file) : source_{file, {}} {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, onError, ignore);
        info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    [[nodiscard]] bool readHeader(uint32_t& width_px, uint32_t& height_px) {
        return info_ != nullptr && header(png_, info_, &source_, &width_px, &height_px);
    }
    [[nodiscard]] bool readPixels(std::span<std::byte> pixels) {
        uint32_t width_px = 0;
        uint32_t height_px = 0;
        if (!readHeader(width_px, height_px) ||
            pixels.size() != size_t{width_px} * height_px * kChannels) {
            return false;
        }
        std::vector<png_bytep> rows(height_px);
        for (size_t y = 0; y < rows.size(); ++y) {
            rows[y] = reinterpret_cast<png_bytep>(pixels.data()) + y * width_px * kChannels;
        }
        return image(png_, info_, rows.data(), size_t{width_px} * kChannels);
    }
    [[nodiscard]] std::string reason() const {
        return source_.reason[0] != '\0' ? source_.reason : "out of memory";
    }

  private:
    // The parts that libpng may leave by longjmp: no object with a destructor lives in them.
    static bool header(
        png_structp png, png_infop info, Source* source, uint32_t* width_px, uint32_t* height_px) {
        if (setjmp(png_jmpbuf(png)) != 0) {
            return false;
        }
        // Sides are judged by the caller; these bounds only keep libpng's own sums in range.
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_chunk_cache_max(png, 128);
        png_set_read_fn(png, source, readBytes);
        png_read_info(png, info);
        *width_px = png_get_image_width(png, info);
        *height_px = png_get_image_height(png, info);
        return true;
    }
    static bool image(png_structp png, png_infop info, png_bytepp rows, size_t row_bytes) {
        if (setjmp(png_jmpbuf(png)) != 0) {
            return false;
        }
        png_set_scale_16(png);
        png_set_expand(png); // palette to RGB, grey to 8 bits, tRNS to alpha
        png_set_gray_to_rgb(png);
        png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
        (void)png_set_interlace_handling(png);
        png_read_update_info(png, info);
        if (png_get_rowbytes(png, info) != row_bytes) {
            png_error(png, "unexpected row size");
        }
        png_read_image(png, rows);
        png_read_end(png, nullptr);
        return true;
    }

    Source source_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

} // namespace

bool isPng(std::span<const std::byte> file) {
    return file.size() >= kSignatureBytes &&
           png_sig_cmp(reinterpret_cast<png_const_bytep>(file.data()), 0, kSignatureBytes) == 0;
}

bool readPngSize(std::span<const std::byte> file,
                 uint32_t& width_px,
                 uint32_t& height_px,
                 std::string& reason) {
    Reader reader(file);
    const bool good = reader.readHeader(width_px, height_px);
    reason = good ? "" : reader.reason();
    return good;
}

bool readPngPixels(std::span<const std::byte> file,
                   std::span<std::byte> pixels,
                   std::string& reason) {
    Reader reader(file);
    const bool good = reader.readPixels(pixels);
    reason = good ? "" : reader.reason();
    return good;
}

} // namespace froxel::gltf
