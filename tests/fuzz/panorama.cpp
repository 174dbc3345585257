// A panorama, .hdr or .exr by its first bytes: values that light can have, or one line.
#include "core/assert.h"
#include "environment/reader.h"
#include "fuzz/target.h"

#include <algorithm>
#include <cmath>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    const auto read = environment::read(std::as_bytes(std::span(data, size)), "panorama");
    if (!read) {
        FROXEL_ASSERT(fuzz::isOneLine(read.error().message), "a refusal is one line");
        return 0;
    }
    const LinearImage& image = read->image;
    FROXEL_ASSERT(image.width_px == 2 * image.height_px &&
                      image.rgb.size() == size_t{3} * image.width_px * image.height_px,
                  "a panorama is twice as wide as high");
    FROXEL_ASSERT(std::all_of(image.rgb.begin(), image.rgb.end(),
                              [](float value) { return std::isfinite(value) && value >= 0; }),
                  "radiance is finite and not negative");
    for (const std::string& warning : read->warnings) {
        FROXEL_ASSERT(fuzz::isOneLine(warning), "a warning is one line");
    }
    return 0;
}
