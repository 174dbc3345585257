// The froxel volume of a frame with fog, and what its shaders are told. Pure.
#pragma once

#include "core/error.h"
#include "interface/fog_io.h"
#include "settings/settings.h"

#include <cstdint>

namespace froxel::render {

// As much as every Vulkan device can bind as one storage buffer.
inline constexpr uint64_t kMostFroxelBytes = uint64_t{128} << 20U;
inline constexpr uint64_t kFroxelBytes = 16; // four floats

// Nothing of lights is left behind this optical depth: e^-16 is below fp32's rounding of 1.
inline constexpr double kOpaqueDepth = 16;

// `settings.size` is what is drawn, `lit_far_m` where lights end (cluster::litDepthRange); a medium
// of constant density ends the volume earlier, where it lets nothing through.
[[nodiscard]] io::Fog
makeFog(const settings::ViewSettings& settings, double lit_far_m, double time_s);

// Of the light flags of surfaces the part that says how lights are fetched, each invocation by
// itself.
[[nodiscard]] uint32_t fogLightFlags(uint32_t surface_light_flags);

[[nodiscard]] uint64_t froxelCount(const io::Fog& fog);

// Errors: kCapacity where the volume is larger than kMostFroxelBytes or `most_texels`.
[[nodiscard]] Result<void> checkFroxels(const io::Fog& fog, uint64_t most_texels);

} // namespace froxel::render
