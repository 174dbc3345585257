#include "encode/image_file.h"

#include "core/text.h"
#include "encode/jpeg_encoder.h"
#include "png/writer.h"

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

Result<void> writePng(const path& file, const PixelView& pixels) {
    const auto bytes = png::write(pixels);
    if (!bytes) {
        return ioError(file, bytes.error().message);
    }
    OutputFile output(file);
    output.write(bytes->data(), bytes->size());
    return output.close();
}

Result<void>
writeJpeg(const path& file, const PixelView& pixels, const settings::Encoding& encoding) {
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

Result<void>
writeImage(const path& file, const PixelView& pixels, const settings::Encoding& encoding) {
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
