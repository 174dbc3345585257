// How many textures of a material a device's shaders may read beside those that every pass has.
#pragma once

#include "gpu/device.h"

#include <cstdint>

namespace froxel::render {

// Images and texel buffers that a pass over surfaces reads at most, beside materials': the frame's
// set and the screen's, or what is seen through a surface, which is no more.
inline constexpr uint32_t kPassTextures = 17;
// And more of one that resolves ids of surfaces that transmit light.
inline constexpr uint32_t kBehindTextures = 2;
// Of these, those with samplers.
inline constexpr uint32_t kPassSamplers = 1;

// Of interface/material_slots.h, from the first: all; or those of surfaces alone, where layers over
// them are too much for the device. Throws StartupError(kUnsupported) where those are too many,
// too.
[[nodiscard]] uint32_t materialSlots(const gpu::DeviceTraits& traits);

} // namespace froxel::render
