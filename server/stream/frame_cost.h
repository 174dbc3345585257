// What a frame costs the device: drawn for its time alone, while nobody is there.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "stream/frame_source.h"

#include <functional>

namespace froxel::stream {

// From one frame to the next of a view of its own, as many under way as keep the device busy: what
// each of many frames takes of whatever is the bound, device or host. Some tenths of a second, or
// three frames. `goes_on` is asked between pieces, and breaks it off. On the thread that `source`
// belongs to. Errors: kCapacity and kUnsupported (this picture cannot be drawn, or it was broken
// off), kDevice (the view is kept for good).
[[nodiscard]] Result<Seconds> measureFrameCost(
    FrameSource& source,
    const settings::ViewSettings& settings,
    const std::function<bool()>& goes_on = [] { return true; });

} // namespace froxel::stream
