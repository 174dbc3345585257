// RGBA8 pixels to JPEG by TurboJPEG. One encoder a thread: it keeps its handle (creating one costs
// milliseconds) and its scratch memory.
#pragma once

#include "encode/encoder.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace froxel::encode {

class JpegEncoder {
  public:
    JpegEncoder(); // throws StartupError when TurboJPEG cannot be set up

    // Exactly the JPEG's bytes. Errors: kInvalidArgument for an empty or inconsistent view or a
    // quality outside 1..100; kIo with TurboJPEG's text otherwise.
    [[nodiscard]] Result<std::vector<std::byte>> encode(const PixelView& pixels,
                                                        const settings::Encoding& encoding);

  private:
    struct HandleDeleter {
        void operator()(void* handle) const noexcept;
    };
    std::unique_ptr<void, HandleDeleter> handle_;
    std::unique_ptr<unsigned char[]> scratch_;
    size_t scratch_bytes_ = 0;
};

// In stripes (encode/jpeg_stripes.h).
[[nodiscard]] std::unique_ptr<Encoder> makeJpegEncoder(size_t thread_count);

} // namespace froxel::encode
