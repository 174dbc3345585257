#include "encode/vp9_encoder.h"

#include "core/assert.h"
#include "core/text.h"
#include "settings/ranges.h"

#include <turbojpeg.h>

#include <algorithm>
#include <string>
#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

namespace froxel::encode {
namespace {

constexpr size_t kPixelBytes = 4;
constexpr uint32_t kMaxSidePx = 65'535; // of the format
// Measured on two scenes: a third cheaper than 7 for 0.1 dB, and 9 loses 0.5 dB more.
constexpr int kSpeed = 8;
constexpr int kFileSpeed = 4; // of files, for which nobody waits
// A frame is meant for the time since the one before it, but for no more than this: what follows a
// pause would otherwise fill the link for as long as the pause was.
constexpr Seconds kMaxInterval{0.1};
constexpr Seconds kMinInterval{1.0 / 240};
constexpr Seconds kFirstInterval{1.0 / 30};
// Of the bits of a usual frame, in percent: a key frame is to pass the link in a few frames' time.
constexpr unsigned kKeyFramePercent = 400;
constexpr unsigned kBufferMs = 1000; // the rate may be off for so long
// A thread is worth its overhead from this much of a picture on.
constexpr uint64_t kThreadAreaPx = 640 * 360;
constexpr uint64_t kMaxThreads = 4;
constexpr uint32_t kTileMinPx = 256; // the format's narrowest tile

Error invalid(std::string message) {
    return {ErrorCode::kInvalidArgument, std::move(message)};
}

Result<void> check(const PixelView& pixels, const settings::Encoding& encoding) {
    const bool empty = pixels.data == nullptr && !pixels.planes;
    if (empty || pixels.width_px == 0 || pixels.height_px == 0 || pixels.width_px > kMaxSidePx ||
        pixels.height_px > kMaxSidePx) {
        return invalid("video of " + numberText(pixels.width_px) + "x" +
                       numberText(pixels.height_px) + " pixels; 1 to " + numberText(kMaxSidePx) +
                       " a side are possible");
    }
    if (!pixels.planes && pixels.stride_bytes < pixels.width_px * kPixelBytes) {
        return invalid("video from rows of " + numberText(pixels.stride_bytes) + " bytes; " +
                       numberText(pixels.width_px) + " pixels need " +
                       numberText(pixels.width_px * kPixelBytes));
    }
    if (!settings::kVideoKbpsRange.contains(encoding.video_kbps)) {
        return invalid("video_kbps is " + numberText(encoding.video_kbps) + "; it must be from " +
                       numberText(settings::kVideoKbpsRange.min) + " to " +
                       numberText(settings::kVideoKbpsRange.max));
    }
    return {};
}

vpx_codec_enc_cfg_t configure(const PixelView& pixels,
                              const settings::Encoding& encoding,
                              size_t thread_count,
                              const std::optional<ConstantQuality>& quality) {
    vpx_codec_enc_cfg_t config{};
    const auto status = vpx_codec_enc_config_default(vpx_codec_vp9_cx(), &config, 0);
    FROXEL_ASSERT(status == VPX_CODEC_OK, "this libvpx has no VP9 encoder");
    const uint64_t area_px = uint64_t{pixels.width_px} * pixels.height_px;
    config.g_w = pixels.width_px;
    config.g_h = pixels.height_px;
    config.g_profile = encoding.chroma == settings::Chroma::k444 ? 1 : 0;
    config.g_timebase = {1, 1'000'000};
    config.g_threads = static_cast<unsigned>(std::clamp<uint64_t>(
        area_px / kThreadAreaPx, 1, std::min<uint64_t>(thread_count, kMaxThreads)));
    config.g_pass = VPX_RC_ONE_PASS;
    config.g_lag_in_frames = 0;
    config.g_error_resilient = 0;
    config.kf_mode = VPX_KF_DISABLED; // key frames where they are asked for
    config.rc_end_usage = VPX_CBR;
    config.rc_target_bitrate = encoding.video_kbps;
    config.rc_dropframe_thresh = 0;
    config.rc_resize_allowed = 0;
    config.rc_min_quantizer = 2;
    config.rc_max_quantizer = 63;
    config.rc_undershoot_pct = 50;
    config.rc_overshoot_pct = 50;
    config.rc_buf_sz = kBufferMs;
    config.rc_buf_initial_sz = kBufferMs / 2;
    config.rc_buf_optimal_sz = kBufferMs / 2;
    if (quality) {
        config.rc_end_usage = VPX_Q;
        config.rc_min_quantizer = 0;
    }
    return config;
}

} // namespace

// libvpx's encoder for pictures of one size and chroma.
struct Vp9Encoder::Stream {
    Stream() = default;
    ~Stream() {
        vpx_img_free(&image);
        if (open) {
            vpx_codec_destroy(&codec);
        }
        if (converter != nullptr) {
            tjDestroy(converter);
        }
    }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    [[nodiscard]] Result<void> begin(const PixelView& pixels,
                                     const settings::Encoding& encoding,
                                     size_t thread_count,
                                     const std::optional<ConstantQuality>& quality);
    [[nodiscard]] bool fits(const PixelView& pixels, const settings::Encoding& encoding) const {
        return image.d_w == pixels.width_px && image.d_h == pixels.height_px &&
               chroma == encoding.chroma;
    }
    [[nodiscard]] Result<void> setRate(uint32_t kbps);
    // What is to be compressed: the picture's planes, or `image` once they were made of its pixels.
    [[nodiscard]] Result<vpx_image_t> convert(const PixelView& pixels);
    [[nodiscard]] Result<EncodedPart>
    compress(const vpx_image_t& planes, bool key, TimePoint drawn_at);
    [[nodiscard]] Error failure(const char* what) {
        const char* detail = vpx_codec_error_detail(&codec);
        return {ErrorCode::kIo, std::string("libvpx: ") + what + ": " + vpx_codec_error(&codec) +
                                    (detail != nullptr ? std::string("; ") + detail : "")};
    }

    vpx_codec_enc_cfg_t config{};
    vpx_codec_ctx_t codec{};
    bool open = false;
    vpx_image_t image{};
    tjhandle converter = nullptr;
    settings::Chroma chroma = settings::Chroma::k420;
    unsigned long deadline = VPX_DL_REALTIME;
    TimePoint last_drawn_at{};
    int64_t next_us = 0; // media time; 0: nothing encoded yet
};

Result<void> Vp9Encoder::Stream::begin(const PixelView& pixels,
                                       const settings::Encoding& encoding,
                                       size_t thread_count,
                                       const std::optional<ConstantQuality>& quality) {
    chroma = encoding.chroma;
    config = configure(pixels, encoding, thread_count, quality);
    if (vpx_codec_enc_init(&codec, vpx_codec_vp9_cx(), &config, 0) != VPX_CODEC_OK) {
        return failure("cannot start");
    }
    open = true;
    const bool full = encoding.chroma == settings::Chroma::k444;
    int tile_columns = 0; // as a power of two
    while ((2U << static_cast<unsigned>(tile_columns)) <= config.g_threads &&
           (pixels.width_px >> static_cast<unsigned>(tile_columns + 1)) >= kTileMinPx) {
        ++tile_columns;
    }
    const bool set_for_use =
        quality ? vpx_codec_control(&codec, VP8E_SET_CPUUSED, kFileSpeed) == VPX_CODEC_OK &&
                      vpx_codec_control(&codec, VP8E_SET_CQ_LEVEL, quality->level) == VPX_CODEC_OK
                : vpx_codec_control(&codec, VP8E_SET_CPUUSED, kSpeed) == VPX_CODEC_OK &&
                      vpx_codec_control(&codec, VP9E_SET_AQ_MODE, 3U) == VPX_CODEC_OK &&
                      vpx_codec_control(&codec, VP8E_SET_STATIC_THRESHOLD, 1U) == VPX_CODEC_OK &&
                      vpx_codec_control(&codec, VP8E_SET_MAX_INTRA_BITRATE_PCT, kKeyFramePercent) ==
                          VPX_CODEC_OK;
    const bool set =
        set_for_use &&
        vpx_codec_control(&codec, VP9E_SET_ROW_MT, config.g_threads > 1 ? 1U : 0U) ==
            VPX_CODEC_OK &&
        vpx_codec_control(&codec, VP9E_SET_TILE_COLUMNS, tile_columns) == VPX_CODEC_OK &&
        vpx_codec_control(&codec, VP9E_SET_COLOR_SPACE, static_cast<int>(VPX_CS_BT_601)) ==
            VPX_CODEC_OK &&
        vpx_codec_control(&codec, VP9E_SET_COLOR_RANGE, static_cast<int>(VPX_CR_FULL_RANGE)) ==
            VPX_CODEC_OK;
    if (!set) {
        return failure("a setting was refused");
    }
    deadline = quality ? VPX_DL_GOOD_QUALITY : VPX_DL_REALTIME;
    converter = tjInitCompress();
    if (converter == nullptr || vpx_img_alloc(&image, full ? VPX_IMG_FMT_I444 : VPX_IMG_FMT_I420,
                                              pixels.width_px, pixels.height_px, 32) == nullptr) {
        return Error{ErrorCode::kIo, "no memory for a picture of video"};
    }
    image.cs = VPX_CS_BT_601;
    image.range = VPX_CR_FULL_RANGE;
    return {};
}

Result<void> Vp9Encoder::Stream::setRate(uint32_t kbps) {
    if (config.rc_target_bitrate != kbps) {
        config.rc_target_bitrate = kbps;
        if (vpx_codec_enc_config_set(&codec, &config) != VPX_CODEC_OK) {
            return failure("the rate cannot be changed");
        }
    }
    return {};
}

// Rows of chroma that an odd size leaves half are in the image's own padding.
Result<vpx_image_t> Vp9Encoder::Stream::convert(const PixelView& pixels) {
    if (pixels.planes) {
        vpx_image_t lent = image;
        for (size_t i = 0; i < pixels.planes->data.size(); ++i) {
            const auto* plane = reinterpret_cast<const unsigned char*>(pixels.planes->data[i]);
            lent.planes[i] = const_cast<unsigned char*>(plane); // libvpx only reads it
            lent.stride[i] = static_cast<int>(pixels.planes->stride_bytes[i]);
        }
        return lent;
    }
    const int status =
        tjEncodeYUVPlanes(converter, reinterpret_cast<const unsigned char*>(pixels.data),
                          static_cast<int>(pixels.width_px), static_cast<int>(pixels.stride_bytes),
                          static_cast<int>(pixels.height_px), TJPF_RGBX, image.planes, image.stride,
                          chroma == settings::Chroma::k444 ? TJSAMP_444 : TJSAMP_420, 0);
    if (status != 0) {
        return Error{ErrorCode::kIo, std::string("TurboJPEG: ") + tjGetErrorStr2(converter)};
    }
    return image;
}

Result<EncodedPart>
Vp9Encoder::Stream::compress(const vpx_image_t& planes, bool key, TimePoint drawn_at) {
    const Seconds since = next_us == 0 ? kFirstInterval : Seconds(drawn_at - last_drawn_at);
    const auto interval_us =
        static_cast<int64_t>(Microseconds(std::clamp(since, kMinInterval, kMaxInterval)).count());
    last_drawn_at = drawn_at;
    next_us += interval_us;
    if (vpx_codec_encode(&codec, &planes, next_us, static_cast<unsigned long>(interval_us),
                         key ? VPX_EFLAG_FORCE_KF : 0, deadline) != VPX_CODEC_OK) {
        return failure("a picture was refused");
    }
    EncodedPart frame{{}, false};
    vpx_codec_iter_t iterator = nullptr;
    while (const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(&codec, &iterator)) {
        if (packet->kind == VPX_CODEC_CX_FRAME_PKT) {
            const auto* bytes = static_cast<const std::byte*>(packet->data.frame.buf);
            frame.bytes.insert(frame.bytes.end(), bytes, bytes + packet->data.frame.sz);
            frame.key = frame.key || (packet->data.frame.flags & VPX_FRAME_IS_KEY) != 0;
        }
    }
    if (frame.bytes.empty()) {
        return failure("a picture gave no frame");
    }
    return frame;
}

Vp9Encoder::Vp9Encoder(size_t thread_count) : thread_count_(std::max<size_t>(thread_count, 1)) {}

Vp9Encoder::Vp9Encoder(size_t thread_count, ConstantQuality quality)
    : thread_count_(std::max<size_t>(thread_count, 1)), quality_(quality) {}

Vp9Encoder::~Vp9Encoder() = default;

Result<EncodedPart> Vp9Encoder::encode(const PixelView& pixels,
                                       const settings::Encoding& encoding,
                                       bool key,
                                       TimePoint drawn_at) {
    if (const auto valid = check(pixels, encoding); !valid) {
        stream_.reset();
        return valid.error();
    }
    const auto frame = [&]() -> Result<EncodedPart> {
        if (!stream_ || !stream_->fits(pixels, encoding)) {
            stream_ = std::make_unique<Stream>();
            if (const auto begun = stream_->begin(pixels, encoding, thread_count_, quality_);
                !begun) {
                return begun.error();
            }
        }
        if (const auto set = stream_->setRate(encoding.video_kbps); !set) {
            return set.error();
        }
        const auto planes = stream_->convert(pixels);
        if (!planes) {
            return planes.error();
        }
        return stream_->compress(*planes, key, drawn_at);
    }();
    if (!frame) {
        stream_.reset();
    }
    return frame;
}

std::unique_ptr<Encoder> makeVp9Encoder(size_t thread_count) {
    return std::make_unique<Vp9Encoder>(thread_count);
}

} // namespace froxel::encode
