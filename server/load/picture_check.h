// Whether a frame's pictures look whole and can be decoded, by their headers alone: nothing is
// decoded.
#pragma once

#include "core/error.h"
#include "froxel/v1/server.pb.h"
#include "protocol/framing.h"

#include <cstdint>
#include <optional>

namespace froxel::load {

// What a picture says of itself.
struct PictureHeader {
    bool key = true;       // decodes without any frame before it
    uint32_t width_px = 0; // of a key frame only
    uint32_t height_px = 0;
};

// VP9 Bitstream Specification 0.7, 6.2 and 7.2: frame marker, profile 0 or 1 with 8 bits, a shown
// frame; of a key frame the sync code and the size. Pure. Errors: kInvalidArgument.
[[nodiscard]] Result<PictureHeader> checkVp9(protocol::ByteSpan bytes);

// All frames of one connection, in their order.
class PictureCheck {
  public:
    // Each picture that stands alone is one of its part's size, a frame says whether it is a key
    // frame, and every other frame of video comes after a key frame with none lost since; `payload`
    // as decodeFrame() returned it. Of a codec whose headers are not read, PNG's among them, this
    // takes the part's word. Errors: kInvalidArgument.
    [[nodiscard]] Result<void> onFrame(const v1::FrameHeader& header, protocol::ByteSpan payload);

    [[nodiscard]] uint64_t keyFrameCount() const { return key_count_; }

  private:
    [[nodiscard]] Result<void>
    checkOrder(const v1::FrameHeader& header, const v1::Part& part, const PictureHeader& picture);

    uint64_t key_count_ = 0;
    std::optional<uint32_t> dropped_count_; // at the last frame of video; none: no key frame yet
};

} // namespace froxel::load
