// What a frame costs the device: drawn for its time alone, while nobody is there.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "stream/frame_source.h"

#include <functional>

namespace froxel::stream {

// From one frame to the next of moving views of its own, as many as keep the device busy: what each
// frame of many viewers takes of whatever is the bound, device or host. A second or two on a GPU,
// some frames on a CPU device. `goes_on` is asked between pieces, and breaks it off. On the thread
// that `source` belongs to. Errors: kCapacity and kUnsupported (this picture cannot be drawn, or it
// was broken off), kDevice (the views are kept for good).
[[nodiscard]] Result<Seconds> measureFrameCost(
    FrameSource& source,
    const settings::ViewSettings& settings,
    const std::function<bool()>& goes_on = [] { return true; });

} // namespace froxel::stream
