// What a picture is like, for programs that cannot look at it.
#pragma once

#include "core/encoded_frame.h"
#include "core/error.h"

#include <cstdint>
#include <map>

namespace froxel::still {

struct PictureFacts {
    double near_black = 0; // share of pixels whose red, green and blue are all at most 8 of 255
    double near_white = 0; // all at least 247
};

// Errors of this and the next: kIo. Pure, any thread.
[[nodiscard]] Result<PictureFacts> factsOf(const SharedBytes& png);

// Of a picture of the debug view "instances".
struct CoveredPixels {
    uint64_t total = 0; // of the picture
    // Where an instance is nearest, by its number, from 0. Others are nowhere.
    std::map<uint32_t, uint64_t> of_instance;
};
[[nodiscard]] Result<CoveredPixels> coveredPixels(const SharedBytes& png);

} // namespace froxel::still
