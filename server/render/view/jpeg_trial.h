// One picture through the JPEG passes by itself, to compare and to time them.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "core/jpeg_format.h"
#include "core/pixel_view.h"
#include "render/view/renderer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace froxel::render {

struct JpegTrial {
    std::vector<std::byte> file; // empty: it did not fit
    Seconds time{0};             // of the device, the shortest of all times; 0: it tells none
};

struct JpegTrialOptions {
    uint32_t times = 1;                      // with the same buffers
    std::optional<uint32_t> scan_bytes = {}; // that there is room for; none: as of a frame
};

// `pixels`: rows without padding. On the render thread, with nothing else on the device. Errors:
// kUnsupported, kDevice. Throws vk::SystemError.
[[nodiscard]] Result<JpegTrial> tryJpeg(RenderDevice& on,
                                        const PixelView& pixels,
                                        const JpegFormat& format,
                                        const JpegTrialOptions& options = {});

} // namespace froxel::render
