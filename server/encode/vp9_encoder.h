// RGBA8 pixels to VP9 by libvpx: one encoder a stream of pictures, since each frame refers to those
// before it. One pass, constant rate, no look-ahead and no reordering: one picture in, one frame
// out. Nothing is ever dropped here, and nothing that a client got is lost by TCP, so there is no
// error resilience to pay for: a client that lost a frame asks for a key frame.
#pragma once

#include "encode/encoder.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace froxel::encode {

// Of a file rather than a stream: every frame has the same quality, and as many bits as that takes.
struct ConstantQuality {
    uint32_t level = 0; // 0 to 63, the best first ("crf" of other programs)
};

class Vp9Encoder final : public Encoder {
  public:
    // Threads that libvpx may use within a frame; it takes fewer for small pictures.
    explicit Vp9Encoder(size_t thread_count);
    // encode() takes no rate then, and some ten times as long.
    Vp9Encoder(size_t thread_count, ConstantQuality quality);
    ~Vp9Encoder() override;

    // The first frame is a key frame, and so is one of another size or chroma than the one before
    // it, one that `key` asks for, and the one after an error. Rate is bits over the time between
    // pictures by `drawn_at`; pauses save up no bits. Errors: kInvalidArgument for an empty or
    // inconsistent view, one too large for VP9, or a rate outside its range; kIo with the library's
    // text otherwise.
    [[nodiscard]] Result<EncodedPart> encode(const PixelView& pixels,
                                             const settings::Encoding& encoding,
                                             bool key,
                                             TimePoint drawn_at) override;
    [[nodiscard]] bool hasThreads() const override { return true; }

  private:
    struct Stream;

    const size_t thread_count_;
    const std::optional<ConstantQuality> quality_;
    std::unique_ptr<Stream> stream_; // none: the next frame begins one
};

[[nodiscard]] std::unique_ptr<Encoder> makeVp9Encoder(size_t thread_count);

} // namespace froxel::encode
