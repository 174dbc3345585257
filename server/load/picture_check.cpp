#include "load/picture_check.h"

#include "core/text.h"
#include "load/jpeg_check.h"
#include "session/proto_enums.h"
#include "session/settings.h"

#include <algorithm>
#include <array>
#include <string>

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

// As people write it: VP9.
std::string nameOf(v1::Codec codec) {
    std::string name = v1::Codec_Name(codec);
    return name.substr(name.find('_') + 1);
}

Result<void> checkSize(const PictureHeader& picture, const v1::Part& part, bool video) {
    if (picture.width_px == part.width() && picture.height_px == part.height()) {
        return {};
    }
    return broken((video ? "a key frame" : "a " + nameOf(part.codec())) + " of " +
                  numberText(picture.width_px) + "x" + numberText(picture.height_px) +
                  " for a part of " + numberText(part.width()) + "x" + numberText(part.height()));
}

Result<PictureHeader> readJpeg(protocol::ByteSpan bytes) {
    const auto size = checkJpeg(bytes);
    if (!size) {
        return size.error();
    }
    return PictureHeader{true, size->width_px, size->height_px};
}

// The codecs whose headers are read.
struct Reader {
    v1::Codec codec;
    Result<PictureHeader> (*read)(protocol::ByteSpan bytes);
};
constexpr std::array kReaders = {Reader{v1::CODEC_JPEG, readJpeg}, Reader{v1::CODEC_VP9, checkVp9}};

Result<PictureHeader> readHeader(const v1::Part& part, protocol::ByteSpan bytes) {
    const auto reader =
        std::find_if(kReaders.begin(), kReaders.end(),
                     [&part](const Reader& known) { return known.codec == part.codec(); });
    return reader != kReaders.end() ? reader->read(bytes)
                                    : PictureHeader{part.key_frame(), part.width(), part.height()};
}

} // namespace

Result<PictureHeader> checkVp9(protocol::ByteSpan bytes) {
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
    PictureHeader header;
    header.key = !bits.flag();
    const bool shown = bits.flag();
    bits.flag(); // error_resilient_mode
    if (!shown) {
        return broken("VP9: a hidden frame");
    }
    if (!header.key) {
        return bits.beyondEnd() ? Result<PictureHeader>(broken("VP9: ends in its header")) : header;
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
    return bits.beyondEnd() ? Result<PictureHeader>(broken("VP9: ends in its header")) : header;
}

Result<void> PictureCheck::onFrame(const v1::FrameHeader& header, protocol::ByteSpan payload) {
    for (const v1::Part& part : header.parts()) {
        const auto picture = readHeader(part, payload.subspan(part.offset(), part.length()));
        if (!picture) {
            return picture.error();
        }
        const auto codec = session::fromProto<settings::Codec>(settings::kCodecNames, part.codec());
        const bool depends = codec && settings::rowOf(*codec).frames_depend;
        const auto checked =
            depends ? checkOrder(header, part, *picture) : checkSize(*picture, part, false);
        if (!checked) {
            return checked;
        }
    }
    return {};
}

Result<void> PictureCheck::checkOrder(const v1::FrameHeader& header,
                                      const v1::Part& part,
                                      const PictureHeader& picture) {
    const auto wrong = [&part](const char* words) {
        return broken(nameOf(part.codec()) + ": " + words);
    };
    if (picture.key != part.key_frame()) {
        return wrong(picture.key ? "a key frame that is not said to be one"
                                 : "said to be a key frame, and is none");
    }
    if (picture.key) {
        ++key_count_;
        dropped_count_ = header.dropped_frames();
        return checkSize(picture, part, true);
    }
    if (!dropped_count_) {
        return wrong("no key frame before it");
    }
    if (*dropped_count_ != header.dropped_frames()) {
        return wrong("refers to a frame that was dropped");
    }
    return {};
}

} // namespace froxel::load
