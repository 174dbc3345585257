// What a picture is like, for programs that cannot look at it.
#pragma once

#include "core/encoded_frame.h"
#include "core/error.h"

namespace froxel::still {

struct PictureFacts {
    double near_black = 0; // share of pixels whose red, green and blue are all at most 8 of 255
    double near_white = 0; // all at least 247
};

// Errors of both: kIo. Pure, any thread.
[[nodiscard]] Result<PictureFacts> factsOf(const SharedBytes& png);

// Of a picture of the debug view "depth": the share of pixels where a solid surface is.
[[nodiscard]] Result<double> coveredShare(const SharedBytes& png);

} // namespace froxel::still
