#include "load/picture_check.h"

#include "core/text.h"
#include "load/jpeg_check.h"

namespace froxel::load {
namespace {

constexpr uint32_t kFrameMarker = 2;
constexpr uint32_t kSyncCode = 0x498342;
constexpr uint32_t kSrgb = 7; // color_space

Error broken(const std::string& what) {
    return {ErrorCode::kInvalidArgument, what};
}

// Most significant bit first; 0 beyond the end.
class BitReader {
  public:
    explicit BitReader(protocol::ByteSpan bytes) : bytes_(bytes) {}
    uint32_t read(uint32_t count) {
        uint32_t value = 0;
        for (; count > 0; --count, ++at_) {
            const uint32_t byte =
                at_ / 8 < bytes_.size() ? std::to_integer<uint32_t>(bytes_[at_ / 8]) : 0;
            value = value << 1U | (byte >> (7 - at_ % 8) & 1U);
        }
        return value;
    }
    bool flag() { return read(1) == 1; }
    [[nodiscard]] bool beyondEnd() const { return at_ > bytes_.size() * 8; }

  private:
    protocol::ByteSpan bytes_;
    size_t at_ = 0;
};

Result<void>
checkSize(const char* what, uint32_t width_px, uint32_t height_px, const v1::Part& part) {
    if (width_px == part.width() && height_px == part.height()) {
        return {};
    }
    return broken(std::string(what) + " of " + numberText(width_px) + "x" + numberText(height_px) +
                  " for a part of " + numberText(part.width()) + "x" + numberText(part.height()));
}

} // namespace

Result<Vp9Header> checkVp9(protocol::ByteSpan bytes) {
    BitReader bits(bytes);
    if (bits.read(2) != kFrameMarker) {
        return broken("VP9: no frame marker in " + numberText(bytes.size()) + " bytes");
    }
    const uint32_t low = bits.read(1);
    const uint32_t profile = low | bits.read(1) << 1U;
    if (profile > 1) {
        return broken("VP9: profile " + numberText(profile) + ", not 0 or 1");
    }
    if (bits.flag()) {
        return broken("VP9: shows a frame again");
    }
    Vp9Header header;
    header.key = !bits.flag();
    const bool shown = bits.flag();
    bits.flag(); // error_resilient_mode
    if (!shown) {
        return broken("VP9: a hidden frame");
    }
    if (!header.key) {
        return bits.beyondEnd() ? Result<Vp9Header>(broken("VP9: ends in its header")) : header;
    }
    if (bits.read(24) != kSyncCode) {
        return broken("VP9: a key frame without sync code");
    }
    const bool srgb = bits.read(3) == kSrgb;
    if (!srgb) {
        bits.flag(); // color_range
    }
    if (profile == 1) {
        bits.read(srgb ? 1 : 3); // subsampling and a reserved bit
    }
    header.width_px = bits.read(16) + 1;
    header.height_px = bits.read(16) + 1;
    return bits.beyondEnd() ? Result<Vp9Header>(broken("VP9: ends in its header")) : header;
}

Result<void> PictureCheck::onFrame(const v1::FrameHeader& header, protocol::ByteSpan payload) {
    for (const v1::Part& part : header.parts()) {
        const auto bytes = payload.subspan(part.offset(), part.length());
        Result<void> checked;
        if (part.codec() == v1::CODEC_JPEG) {
            const auto size = checkJpeg(bytes);
            checked = size ? checkSize("a JPEG", size->width_px, size->height_px, part)
                           : Result<void>(size.error());
        } else if (part.codec() == v1::CODEC_VP9) {
            checked = checkVideo(header, part, bytes);
        }
        if (!checked) {
            return checked;
        }
    }
    return {};
}

Result<void> PictureCheck::checkVideo(const v1::FrameHeader& header,
                                      const v1::Part& part,
                                      protocol::ByteSpan bytes) {
    const auto video = checkVp9(bytes);
    if (!video) {
        return video.error();
    }
    if (video->key != part.key_frame()) {
        return broken(video->key ? "VP9: a key frame that is not said to be one"
                                 : "VP9: said to be a key frame, and is none");
    }
    if (video->key) {
        ++key_count_;
        dropped_count_ = header.dropped_frames();
        return checkSize("a key frame", video->width_px, video->height_px, part);
    }
    if (!dropped_count_) {
        return broken("VP9: no key frame before it");
    }
    if (*dropped_count_ != header.dropped_frames()) {
        return broken("VP9: refers to a frame that was dropped");
    }
    return {};
}

} // namespace froxel::load
