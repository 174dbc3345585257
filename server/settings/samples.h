// Pictures that are the mean of several samples a pixel, each a frame of its own.
#pragma once

#include "core/math.h"
#include "settings/camera.h"
#include "settings/settings.h"

#include <cstdint>

namespace froxel::settings {

inline constexpr uint32_t kMeanSamples = 16;

// Where in a pixel a sample lies, from its middle, in pixels, x right and y down. No two of them
// share a sixteenth of a pixel, across or down (Hammersley's points, 1960), so that steep edges and
// flat ones get as many steps.
[[nodiscard]] constexpr glm::dvec2 samplePlace(uint32_t sample) {
    const uint32_t turned =
        (sample & 1U) << 3U | (sample & 2U) << 1U | (sample & 4U) >> 1U | (sample & 8U) >> 3U;
    return {(sample + 0.5) / kMeanSamples - 0.5, (turned + 0.5) / kMeanSamples - 0.5};
}

// The camera that has this place, as samplePlace() gives one, in the middle of each pixel.
[[nodiscard]] inline Camera centredAt(Camera camera, const Size& size, const glm::dvec2& place_px) {
    camera.lens_shift +=
        2.0 * glm::dvec2(place_px.x, -place_px.y) / glm::dvec2(size.width_px, size.height_px);
    return camera;
}

// The camera of a sample. sample: below kMeanSamples.
[[nodiscard]] inline Camera sampled(const Camera& camera, const Size& size, uint32_t sample) {
    return centredAt(camera, size, samplePlace(sample));
}

// Frames whose mean a still with these settings is.
[[nodiscard]] inline uint32_t framesOf(const ViewSettings& settings) {
    return settings.antialiasing == Antialiasing::kMean16 && settings.debug.view == DebugView::kNone
               ? kMeanSamples
               : 1;
}

} // namespace froxel::settings
