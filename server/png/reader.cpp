#include "png/reader.h"

#include "core/text.h"
#include "png/failure.h"

#include <cstring>
#include <vector>

namespace froxel::png {
namespace {

constexpr size_t kSignatureBytes = 8;
constexpr size_t kChannels = 4;
constexpr uint64_t kDeflateRatio = 1032; // of zlib at best: zlib.net/zlib_tech.html

void readBytes(png_structp png, png_bytep data, size_t size) {
    auto* left = static_cast<std::span<const std::byte>*>(png_get_io_ptr(png));
    if (size > left->size()) {
        png_error(png, "the file is cut off");
    }
    std::memcpy(data, left->data(), size);
    *left = left->subspan(size);
}

class Reader {
  public:
    explicit Reader(std::span<const std::byte> file) : left_(file) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure_, onError, onWarning);
        info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    [[nodiscard]] Result<Header> header() {
        Header header;
        uint64_t packed_bytes = 0;
        const size_t file_bytes = left_.size();
        if (info_ == nullptr || !read(png_, info_, &left_, &header, &packed_bytes)) {
            return failure_.error();
        }
        const PictureSize& size = header.size;
        if (packed_bytes > file_bytes * kDeflateRatio) {
            return Error{ErrorCode::kIo, numberText(file_bytes) + " bytes cannot hold the " +
                                             numberText(size.width_px) + "x" +
                                             numberText(size.height_px) +
                                             " pixels that its header tells"};
        }
        return header;
    }
    // After the header.
    [[nodiscard]] Result<void> pixels(const PictureSize& size, std::span<std::byte> rgba8) {
        const size_t row_bytes = size.width_px * kChannels;
        std::vector<png_bytep> rows(size.height_px);
        for (size_t y = 0; y < rows.size(); ++y) {
            rows[y] = reinterpret_cast<png_bytep>(rgba8.data()) + y * row_bytes;
        }
        if (!pixels(png_, info_, rows.data(), row_bytes)) {
            return failure_.error();
        }
        return {};
    }

  private:
    // The parts that libpng may leave by longjmp: no object with a destructor lives in them.
    static bool read(png_structp png,
                     png_infop info,
                     std::span<const std::byte>* left,
                     Header* header,
                     uint64_t* packed_bytes) {
        if (setjmp(png_jmpbuf(png)) != 0) {
            return false;
        }
        // Sides are judged by the caller; these bounds only keep libpng's own sums in range.
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_chunk_cache_max(png, 128);
        png_set_read_fn(png, left, readBytes);
        png_read_info(png, info);
        header->size = {png_get_image_width(png, info), png_get_image_height(png, info)};
        header->bits_per_channel = png_get_bit_depth(png, info);
        *packed_bytes = uint64_t{png_get_rowbytes(png, info)} * header->size.height_px;
        return true;
    }
    static bool pixels(png_structp png, png_infop info, png_bytepp rows, size_t row_bytes) {
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

    std::span<const std::byte> left_;
    Failure failure_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

} // namespace

bool isPng(std::span<const std::byte> file) {
    return file.size() >= kSignatureBytes &&
           png_sig_cmp(reinterpret_cast<png_const_bytep>(file.data()), 0, kSignatureBytes) == 0;
}

Result<Header> readHeader(std::span<const std::byte> file) {
    return Reader(file).header();
}

Result<PictureSize> readSize(std::span<const std::byte> file) {
    const auto header = readHeader(file);
    return header ? Result<PictureSize>(header->size) : header.error();
}

Result<void> readPixels(std::span<const std::byte> file, std::span<std::byte> rgba8) {
    Reader reader(file);
    const auto header = reader.header();
    if (!header) {
        return header.error();
    }
    const PictureSize& size = header->size;
    if (rgba8.size() != size.pixelCount() * kChannels) {
        return Error{ErrorCode::kInvalidArgument, "PNG of " + numberText(size.width_px) + "x" +
                                                      numberText(size.height_px) + " pixels into " +
                                                      numberText(rgba8.size()) + " bytes"};
    }
    return reader.pixels(size, rgba8);
}

} // namespace froxel::png
