// One viewer's way from pixels to its connection: at most one picture in the encoder and one
// before it, so that pictures leave in order and frame N encodes while N + 1 is drawn.
//
// The viewer's video encoder is here, while it wants video. Whatever it encodes is delivered, and
// what is lost is lost before it, so that no frame refers to one that never left.
#pragma once

#include "core/frame_fates.h"
#include "core/pixel_view.h"
#include "encode/encode_pool.h"
#include "session/stream_port.h"
#include "stream/compared_picture.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace froxel::stream {

struct DrawnFrame {
    PixelLease pixels;
    uint64_t key_requests = 0;   // key frames asked for so far
    uint64_t version = 0;        // SessionState::version of what it shows
    session::FrameRecord record; // what is known before encoding
    Seconds cost{0};             // of drawing it
    TimePoint drawn_at{};
    std::shared_ptr<ComparedSides> compared = {}; // with the left side; `pixels` are the right one
};

class FramePipeline : public std::enable_shared_from_this<FramePipeline> {
  public:
    static constexpr uint32_t kCapacity = 2;

    // `on_progress` runs whenever a picture has left, on an encoder thread or in push(); must not
    // throw. `session` is for the log; `fates` counts.
    FramePipeline(encode::EncodePool& pool,
                  session::SessionId session,
                  std::weak_ptr<session::FrameSink> sink,
                  std::shared_ptr<FrameFates> fates,
                  std::function<void()> on_progress);

    // At most kCapacity at a time; a lossless one that waits for an encoder gives way. Render
    // thread.
    void push(DrawnFrame frame);
    // Pictures here, in the encoder or before it. Any thread.
    [[nodiscard]] uint32_t size() const;
    // Pictures that never reached the connection, since the last call. Any thread.
    struct Losses {
        uint32_t count = 0;
        bool retry = false; // the encoder was full: what they showed has to be drawn again
    };
    [[nodiscard]] Losses takeLosses();
    // What cores worked on its pictures since the last call. Any thread.
    [[nodiscard]] Seconds takeWork();

  private:
    // Before an encoder has the pixels.
    void keepDepth();
    void codeDepth();
    void startEncoding();
    // What makes one picture of both sides; none: nothing is compared.
    [[nodiscard]] std::function<PixelLease(PixelLease)> composition();
    [[nodiscard]] std::optional<encode::VideoJob> videoJob(const DrawnFrame& frame);
    void onEncoded(Result<EncodedFrame> result);
    void finish(Losses losses);

    encode::EncodePool& pool_;
    const session::SessionId session_;
    const std::weak_ptr<session::FrameSink> sink_;
    const std::shared_ptr<FrameFates> fates_;
    const std::function<void()> on_progress_;

    mutable std::mutex mutex_;
    // Its pixels have gone to the encoder. Whoever fills it owns what is inside until finish();
    // the mutex guards only whether it is filled.
    std::optional<DrawnFrame> encoding_;
    std::optional<DrawnFrame> waiting_;
    // Like what is inside of `encoding_`.
    std::shared_ptr<encode::Encoder> video_; // none: the next frame of video is a key frame
    settings::Codec video_codec_{};          // which that one is of
    uint64_t key_requests_ = 0;              // served so far
    std::vector<float> inverse_distances_; // of the vertices of its depth mesh; empty: it has none
    std::shared_ptr<const protocol::CodedDepthMesh> depth_; // newest; null: none so far
    uint64_t depth_number_ = 0;                             // of that
    uint64_t depth_version_ = 0; // DrawnFrame::version of a picture that it is of
    Losses losses_;
    Seconds work_{0};
};

} // namespace froxel::stream
