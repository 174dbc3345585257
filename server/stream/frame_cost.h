// What a frame costs the device: drawn for its time alone, before anybody is there.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "stream/frame_source.h"

namespace froxel::stream {

// Wall time of a frame of a view of its own, as many under way as keep the device busy; the first,
// which compiles pipelines, is not counted. On the thread that `source` belongs to. Errors:
// kCapacity and kUnsupported (this picture cannot be drawn), kDevice (the view is kept for good).
[[nodiscard]] Result<Seconds> measureFrameCost(FrameSource& source,
                                               const settings::ViewSettings& settings);

} // namespace froxel::stream
