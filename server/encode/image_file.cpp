#include "encode/image_file.h"

#include "core/text.h"
#include "encode/jpeg_encoder.h"
#include "encode/radiance_encoder.h"
#include "png/writer.h"

#include <algorithm>
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
    if (extension == ".exr") {
        return ImageFormat::kExr;
    }
    if (extension == ".pfm") {
        return ImageFormat::kPfm;
    }
    return invalid(file, "the name must end in .png, .jpg, .jpeg, .exr or .pfm");
}

Result<void>
writeImage(const path& file, const PixelView& pixels, const settings::Encoding& encoding) {
    const auto format = imageFormatOf(file);
    if (!format) {
        return format.error();
    }
    if (!outputsOf(*format).none()) {
        return invalid(file, "8-bit pixels go to .png or .jpg; .exr and .pfm hold linear radiance");
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

Result<void> writeRadiance(const path& file, const LinearImage& image) {
    const auto format = imageFormatOf(file);
    if (!format) {
        return format.error();
    }
    if (outputsOf(*format).none()) {
        return invalid(file, "linear radiance goes to .exr or .pfm");
    }
    const auto bytes = *format == ImageFormat::kExr ? exrOf(image) : pfmOf(image);
    if (!bytes) {
        return Error{bytes.error().code, file.string() + ": " + bytes.error().message};
    }
    OutputFile output(file);
    output.write(bytes->data(), bytes->size());
    return output.close();
}

} // namespace froxel::encode
