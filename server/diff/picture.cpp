#include "diff/picture.h"

#include "core/text.h"
#include "diff/pfm_reader.h"
#include "exr/reader.h"
#include "jpeg/reader.h"
#include "png/reader.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace froxel::diff {
namespace {

Result<void> check(const PictureSize& size) {
    if (size.pixelCount() > kMaxPixels) {
        return Error{ErrorCode::kCapacity, "has " + numberText(size.width_px) + "x" +
                                               numberText(size.height_px) + " pixels; at most " +
                                               numberText(kMaxPixels) + " can be compared"};
    }
    return {};
}

std::string transparencyWarning(const ShownPicture& picture) {
    for (size_t i = 3; i < picture.rgba8.size(); i += 4) {
        if (picture.rgba8[i] != std::byte{255}) {
            return "has transparent pixels; only their colours are compared";
        }
    }
    return "";
}

// `size`: what the format says of the file; `pixels` reads them and returns a warning.
template <class Pixels>
Result<PictureFile>
shownFile(const Result<PictureSize>& size, const std::string& format, const Pixels& pixels) {
    const auto broken = [&format](const Error& error) {
        return Error{error.code,
                     error.code == ErrorCode::kIo
                         ? "is a broken " + format + " file: " + printable(error.message)
                         : error.message};
    };
    if (!size) {
        return broken(size.error());
    }
    if (auto wanted = check(*size); !wanted) {
        return wanted.error();
    }
    ShownPicture picture{*size, std::vector<std::byte>(size->pixelCount() * 4)};
    const Result<std::string> warning = pixels(picture.rgba8);
    if (!warning) {
        return broken(warning.error());
    }
    PictureFile file;
    for (const std::string& text : {*warning, transparencyWarning(picture)}) {
        if (!text.empty()) {
            file.warnings.push_back(text);
        }
    }
    file.picture = std::move(picture);
    return file;
}

Result<PictureFile> pngFile(std::span<const std::byte> bytes) {
    const auto header = png::readHeader(bytes);
    const auto size = header ? Result<PictureSize>(header->size) : header.error();
    return shownFile(size, "PNG", [&](std::span<std::byte> rgba8) -> Result<std::string> {
        if (const auto read = png::readPixels(bytes, rgba8); !read) {
            return read.error();
        }
        return header->bits_per_channel == 16
                   ? std::string("has 16 bits a channel; the upper 8 are compared")
                   : std::string();
    });
}

Result<PictureFile> exrFile(std::span<const std::byte> bytes) {
    auto picture = exr::read(bytes, [](int64_t width_px, int64_t height_px) {
        // Of windows beyond 32 bits.
        constexpr int64_t kMaxSide = 1 << 30;
        return check({static_cast<uint32_t>(std::min(width_px, kMaxSide)),
                      static_cast<uint32_t>(std::min(height_px, kMaxSide))});
    });
    if (!picture) {
        return picture.error();
    }
    return PictureFile{std::move(picture->image), std::move(picture->warnings)};
}

Result<PictureFile> decodeUnnamed(std::span<const std::byte> bytes) {
    if (png::isPng(bytes)) {
        return pngFile(bytes);
    }
    if (jpeg::isJpeg(bytes)) {
        return shownFile(jpeg::readSize(bytes), "JPEG", [&](std::span<std::byte> rgba8) {
            return jpeg::readPixels(bytes, rgba8);
        });
    }
    if (exr::isExr(bytes)) {
        return exrFile(bytes);
    }
    if (isPfm(bytes)) {
        auto image = readPfm(bytes, check);
        return image ? Result<PictureFile>(PictureFile{std::move(*image), {}}) : image.error();
    }
    return Error{ErrorCode::kUnsupported, "is no picture that can be compared (" +
                                              numberText(bytes.size()) +
                                              " bytes); expected PNG, JPEG, OpenEXR or PFM"};
}

} // namespace

Result<PictureFile> decode(std::span<const std::byte> file, const std::string& name) {
    auto decoded = decodeUnnamed(file);
    if (!decoded) {
        return Error{decoded.error().code, name + " " + decoded.error().message};
    }
    for (std::string& warning : decoded->warnings) {
        warning = name + " " + warning;
    }
    return decoded;
}

Result<PictureFile> read(const std::filesystem::path& path) {
    const std::string name = printable(path.string(), 400);
    const auto failed = [&name](int code) {
        return Error{ErrorCode::kIo,
                     "cannot read '" + name + "': " + std::generic_category().message(code)};
    };
    std::error_code failure;
    const uint64_t bytes = std::filesystem::file_size(path, failure); // fails for what is no file
    if (failure) {
        return failed(failure.value());
    }
    if (bytes > kMaxFileBytes) {
        return Error{ErrorCode::kCapacity, name + " has " + numberText(bytes) + " bytes; at most " +
                                               numberText(kMaxFileBytes) + " can be read"};
    }
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    std::vector<std::byte> file(bytes);
    stream.read(reinterpret_cast<char*>(file.data()), static_cast<std::streamsize>(file.size()));
    if (!stream || static_cast<uint64_t>(stream.gcount()) != bytes) {
        return failed(errno != 0 ? errno : EIO);
    }
    return decode(file, name);
}

} // namespace froxel::diff
