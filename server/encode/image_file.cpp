#include "encode/image_file.h"

#include "core/text.h"
#include "encode/jpeg_encoder.h"

#include <png.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

namespace froxel::encode {
namespace {

using std::filesystem::path;

Error ioError(const path& file, const std::string& reason) {
    return Error{ErrorCode::kIo, file.string() + ": cannot be written: " + reason};
}

Error invalid(const path& file, const std::string& reason) {
    return Error{ErrorCode::kInvalidArgument, file.string() + ": " + reason};
}

// A file that removes itself unless it was closed without an error.
class OutputFile {
  public:
    explicit OutputFile(path file)
        : path_(std::move(file)), stream_(std::fopen(path_.c_str(), "wb")) {
        if (stream_ == nullptr) {
            fail();
        }
    }
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile() {
        if (stream_ != nullptr) {
            std::fclose(stream_);
            std::remove(path_.c_str());
        }
    }

    void write(const void* data, size_t bytes) {
        if (ok() && std::fwrite(data, 1, bytes, stream_) != bytes) {
            fail();
        }
    }
    [[nodiscard]] bool ok() const { return error_ == 0; }
    [[nodiscard]] Result<void> close() {
        if (!ok()) {
            return ioError(path_, std::strerror(error_));
        }
        if (std::fclose(std::exchange(stream_, nullptr)) != 0) {
            fail();
            std::remove(path_.c_str());
            return ioError(path_, std::strerror(error_));
        }
        return {};
    }

  private:
    void fail() { error_ = errno != 0 ? errno : EIO; }

    path path_;
    std::FILE* stream_;
    int error_ = 0;
};

// libpng reports through longjmp; this keeps it among plain C frames. Its text goes to `reason`.
struct PngSink {
    OutputFile* file;
    char reason[96];
};

void pngFail(png_structp png, png_const_charp text) {
    auto* sink = static_cast<PngSink*>(png_get_error_ptr(png));
    std::snprintf(sink->reason, sizeof sink->reason, "%s", text);
    png_longjmp(png, 1);
}

void pngIgnore(png_structp /*png*/, png_const_charp /*warning*/) {}

void pngWrite(png_structp png, png_bytep data, size_t bytes) {
    auto* sink = static_cast<PngSink*>(png_get_io_ptr(png));
    sink->file->write(data, bytes);
    if (!sink->file->ok()) {
        png_error(png, "write failed");
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

Result<void> writePng(const path& file, const PixelView& pixels) {
    OutputFile output(file);
    if (!output.ok()) {
        return output.close();
    }
    PngSink sink{&output, {}};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, pngFail, pngIgnore);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool written = info != nullptr && emitPng(png, info, &sink, pixels);
    png_destroy_write_struct(&png, &info);
    if (!written && output.ok()) {
        return ioError(file, sink.reason[0] != '\0' ? sink.reason : "libpng cannot start");
    }
    return output.close();
}

Result<void> writeJpeg(const path& file, const PixelView& pixels, const view::Encoding& encoding) {
    JpegEncoder encoder;
    const auto jpeg = encoder.encode(pixels, encoding);
    if (!jpeg) {
        return Error{jpeg.error().code, file.string() + ": " + jpeg.error().message};
    }
    OutputFile output(file);
    output.write(jpeg->data(), jpeg->size());
    return output.close();
}

} // namespace

Result<ImageFormat> imageFormatOf(const path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    });
    if (extension == ".png") {
        return ImageFormat::kPng;
    }
    if (extension == ".jpg" || extension == ".jpeg") {
        return ImageFormat::kJpeg;
    }
    if (extension == ".pfm") {
        return ImageFormat::kPfm;
    }
    return invalid(file, "the name must end in .png, .jpg, .jpeg or .pfm");
}

Result<void> writeImage(const path& file, const PixelView& pixels, const view::Encoding& encoding) {
    const auto format = imageFormatOf(file);
    if (!format) {
        return format.error();
    }
    if (*format == ImageFormat::kPfm) {
        return invalid(file, "8-bit pixels go to .png or .jpg; .pfm holds linear radiance");
    }
    if (pixels.data == nullptr || pixels.width_px == 0 || pixels.height_px == 0 ||
        pixels.stride_bytes < size_t{pixels.width_px} * 4) {
        return invalid(file, "a picture of " + numberText(pixels.width_px) + "x" +
                                 numberText(pixels.height_px) + " pixels with rows of " +
                                 numberText(pixels.stride_bytes) + " bytes cannot be written");
    }
    return *format == ImageFormat::kPng ? writePng(file, pixels)
                                        : writeJpeg(file, pixels, encoding);
}

Result<void>
writePfm(const path& file, uint32_t width_px, uint32_t height_px, std::span<const float> rgb) {
    static_assert(std::endian::native == std::endian::little, "PFM is written as it lies here");
    const auto format = imageFormatOf(file);
    if (!format) {
        return format.error();
    }
    if (*format != ImageFormat::kPfm) {
        return invalid(file, "linear radiance goes to .pfm");
    }
    const size_t row_floats = size_t{width_px} * 3;
    if (row_floats == 0 || height_px == 0 || rgb.size() != row_floats * height_px) {
        return invalid(file, numberText(rgb.size()) + " values do not make " +
                                 numberText(width_px) + "x" + numberText(height_px) + " pixels");
    }
    OutputFile output(file);
    // The negative scale says little endian; rows go bottom-up.
    const std::string header =
        "PF\n" + numberText(width_px) + " " + numberText(height_px) + "\n-1.0\n";
    output.write(header.data(), header.size());
    for (size_t y = height_px; y-- > 0;) {
        output.write(rgb.data() + y * row_floats, row_floats * sizeof(float));
    }
    return output.close();
}

} // namespace froxel::encode
