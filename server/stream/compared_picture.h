// The one picture of a frame that is compared, made of both sides' pixels.
#pragma once

#include "core/pixel_view.h"
#include "session/comparison.h"
#include "session/state_message.h"
#include "settings/settings.h"

namespace froxel::stream {

// Between the render thread, which fills it, and an encoder's, which makes the picture of it.
struct ComparedSides {
    PixelLease left;
    session::CompareShow show = session::CompareShow::kSides;
    bool divided = false;
    double split = 0.5; // of a divided picture
    // Where they differ, each side is shown as a JPEG of it comes out of a decoder.
    settings::Encoding left_encoding;
    settings::Encoding right_encoding;
    bool flip_wanted = false; // which takes 0.3 s of 1280x720 pixels; a heat map has it anyway
};

// Fills the figures in `record`. Ends both leases. Any thread. Throws std::bad_alloc.
[[nodiscard]] PixelLease
compose(ComparedSides& sides, PixelLease right, session::ComparedRecord& record);

} // namespace froxel::stream
