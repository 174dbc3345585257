// What the render loop needs of a renderer, and no more: the real one is behind renderer_source.h,
// tests bring their own. Used by the render thread only; a PixelLease may end on any thread.
#pragma once

#include "core/error.h"
#include "core/frame_stats.h"
#include "core/pixel_view.h"
#include "view/settings.h"

#include <cstdint>
#include <memory>

namespace froxel::stream {

struct SourceFrame {
    PixelLease pixels;
    FrameStats stats;
};

// One viewer's targets. Frames complete in the order of submission.
class ViewSource {
  public:
    virtual ~ViewSource() = default;
    // Whether a readback slot is free.
    [[nodiscard]] virtual bool canSubmit() const = 0;
    // Starts one frame at `time_s` of the lights' clock. Errors: kCapacity when this size does not
    // fit and kUnsupported when the device cannot do what the settings ask for (earlier ones still
    // work), kDevice when the device is lost.
    [[nodiscard]] virtual Result<void> submit(const view::ViewSettings& settings,
                                              double time_s) = 0;
    // Waits for the oldest frame submitted. Errors: kDevice.
    [[nodiscard]] virtual Result<SourceFrame> collect() = 0;
};

// A scene on a device.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    // Frames submitted at once that keep the device busy: 1 where the host is the device.
    [[nodiscard]] virtual uint32_t depth() const = 0;
    // Errors: kCapacity, kDevice.
    [[nodiscard]] virtual Result<std::unique_ptr<ViewSource>> makeView() = 0;
};

} // namespace froxel::stream
