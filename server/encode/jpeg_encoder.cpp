#include "encode/jpeg_encoder.h"

#include "core/text.h"
#include "encode/jpeg_format.h"
#include "encode/jpeg_stripes.h"
#include "settings/ranges.h"

#include <climits>
#include <turbojpeg.h>

#include <string>

namespace froxel::encode {
namespace {

constexpr size_t kPixelBytes = 4;
// The format's own limit on either side.
constexpr uint32_t kMaxSidePx = 65'500;

Error invalid(std::string message) {
    return Error{ErrorCode::kInvalidArgument, std::move(message)};
}

Result<void> check(const PixelView& pixels, const settings::Encoding& encoding) {
    if (pixels.data == nullptr || pixels.width_px == 0 || pixels.height_px == 0 ||
        pixels.width_px > kMaxSidePx || pixels.height_px > kMaxSidePx) {
        return invalid("JPEG of " + numberText(pixels.width_px) + "x" +
                       numberText(pixels.height_px) + " pixels; 1 to " + numberText(kMaxSidePx) +
                       " a side are possible");
    }
    if (pixels.stride_bytes < pixels.width_px * kPixelBytes || pixels.stride_bytes > INT_MAX) {
        return invalid("JPEG from rows of " + numberText(pixels.stride_bytes) + " bytes; " +
                       numberText(pixels.width_px) + " pixels need " +
                       numberText(pixels.width_px * kPixelBytes));
    }
    if (!settings::kQualityRange.contains(encoding.quality)) {
        return invalid("JPEG quality is " + numberText(encoding.quality) +
                       "; it must be from 1 to 100");
    }
    return {};
}

// Whether the device made a file of it, or was to.
bool isFile(const PixelView& pixels) {
    return pixels.data == nullptr && !pixels.planes && pixels.width_px > 0;
}

Result<EncodedPart> copyOfFile(const PixelView& pixels) {
    if (pixels.jpeg.empty()) {
        return Error{ErrorCode::kIo, "the JPEG is larger than there is room for"};
    }
    return EncodedPart{{pixels.jpeg.begin(), pixels.jpeg.end()}};
}

class StripedJpegEncoder final : public Encoder {
  public:
    [[nodiscard]] Result<EncodedPart> encode(const PixelView& part,
                                             const settings::Encoding& encoding,
                                             bool /*key*/,
                                             TimePoint /*drawn_at*/) override {
        if (isFile(part)) {
            return copyOfFile(part);
        }
        auto bytes = jpeg_.encode(part, encoding);
        if (!bytes) {
            return bytes.error();
        }
        return EncodedPart{std::move(*bytes)};
    }
    [[nodiscard]] std::vector<PixelView>
    cut(const PixelView& pixels, const settings::Encoding& encoding, size_t wanted) const override {
        return isFile(pixels) ? std::vector{pixels} : cutStripes(pixels, encoding.chroma, wanted);
    }
    [[nodiscard]] Result<std::vector<std::byte>> join(std::span<const std::vector<std::byte>> parts,
                                                      uint32_t height_px) const override {
        return joinStripes(parts, height_px);
    }

  private:
    JpegEncoder jpeg_;
};

} // namespace

void JpegEncoder::HandleDeleter::operator()(void* handle) const noexcept {
    tjDestroy(handle);
}

JpegEncoder::JpegEncoder() : handle_(tjInitCompress()) {
    if (!handle_) {
        throw StartupError({ErrorCode::kUnsupported,
                            std::string("TurboJPEG cannot start: ") + tjGetErrorStr2(nullptr)});
    }
}

Result<std::vector<std::byte>> JpegEncoder::encode(const PixelView& pixels,
                                                   const settings::Encoding& encoding) {
    if (const auto valid = check(pixels, encoding); !valid) {
        return valid.error();
    }
    const auto width = static_cast<int>(pixels.width_px);
    const auto height = static_cast<int>(pixels.height_px);
    const int subsampling = encoding.chroma == settings::Chroma::k444 ? TJSAMP_444 : TJSAMP_420;
    const size_t bound = tjBufSize(width, height, subsampling);
    if (bound > scratch_bytes_) {
        scratch_ = std::make_unique_for_overwrite<unsigned char[]>(bound);
        scratch_bytes_ = bound;
    }
    const int transform = jpegTransform(encoding.quality) == JpegTransform::kFast
                              ? TJFLAG_FASTDCT
                              : TJFLAG_ACCURATEDCT;
    const int flags = TJFLAG_NOREALLOC | transform;
    unsigned char* out = scratch_.get();
    unsigned long out_bytes = scratch_bytes_;
    const int status =
        tjCompress2(handle_.get(), reinterpret_cast<const unsigned char*>(pixels.data), width,
                    static_cast<int>(pixels.stride_bytes), height, TJPF_RGBX, &out, &out_bytes,
                    subsampling, static_cast<int>(encoding.quality), flags);
    if (status != 0) {
        return Error{ErrorCode::kIo, std::string("TurboJPEG: ") + tjGetErrorStr2(handle_.get())};
    }
    const auto* bytes = reinterpret_cast<const std::byte*>(out);
    return std::vector<std::byte>(bytes, bytes + out_bytes);
}

std::unique_ptr<Encoder> makeJpegEncoder(size_t /*thread_count*/) {
    return std::make_unique<StripedJpegEncoder>();
}

} // namespace froxel::encode
