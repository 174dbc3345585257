// The one table of what is accepted: options, commands, the page's controls and the documentation
// all take their bounds from here.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

namespace froxel::view {

template <class T>
struct Range {
    std::string_view field; // the protocol's and the command line's name
    T min;
    T max;
    [[nodiscard]] constexpr bool contains(T value) const { return value >= min && value <= max; }
};

inline constexpr Range<uint32_t> kWidthRange{"width", 16, 4096};
inline constexpr Range<uint32_t> kHeightRange{"height", 16, 4096};
inline constexpr Range<uint32_t> kLightCountRange{"lights", 0, 1'000'000};
inline constexpr Range<double> kLightRadiusRange{"light_radius", 0.001, 10'000.0};
inline constexpr Range<double> kLightIntensityRange{"light_intensity", 0.0, 1'000'000.0};
inline constexpr Range<double> kLightCutoffRange{"light_cutoff", 0.0, 1'000.0};
inline constexpr Range<uint32_t> kListCapRange{"list_cap", 0, 65'535};
inline constexpr Range<double> kLightSpeedRange{"light_speed", 0.0, 100.0};
inline constexpr Range<double> kAmbientRange{"ambient", 0.0, 1'000.0};
inline constexpr Range<uint32_t> kGridXRange{"grid.x", 1, 128};
inline constexpr Range<uint32_t> kGridYRange{"grid.y", 1, 128};
inline constexpr Range<uint32_t> kGridZRange{"grid.z", 1, 256};
inline constexpr Range<double> kExposureRange{"exposure", 0.0001, 10'000.0};
inline constexpr Range<double> kFovRange{"fov_deg", 1.0, 170.0};
inline constexpr Range<double> kHalfHeightRange{"half_height", 0.0001, 1e7};
// Half pictures: enough for one of 64 x 64 tiles of a wall.
inline constexpr Range<double> kLensShiftXRange{"lens_shift.x", -64.0, 64.0};
inline constexpr Range<double> kLensShiftYRange{"lens_shift.y", -64.0, 64.0};
inline constexpr Range<double> kPositionRange{"position", -1e7, 1e7};
inline constexpr Range<double> kFocusRange{"focus", 1e-6, 1e8}; // from eye to target
inline constexpr Range<double> kUpRange{"up", 1e-6, 1e8};       // length of the up vector
inline constexpr Range<uint32_t> kQualityRange{"quality", 1, 100};
inline constexpr Range<double> kTargetFpsRange{"target_fps", 0.0, 240.0}; // 0: none
inline constexpr Range<uint32_t> kVideoKbpsRange{"video_kbps", 100, 100'000};
inline constexpr Range<double> kToonRange{"toon", 0.0, 1.0};
inline constexpr Range<double> kToonSlopeRange{"toon.slope", -20.0, 20.0};
inline constexpr Range<double> kDebugScaleRange{"debug_scale_max", 0.0, 1e6}; // 0: chosen
inline constexpr Range<uint32_t> kPeelLayersRange{"peel_layers", 1, 16};
inline constexpr Range<double> kOutlineStrengthRange{"outline_strength", 0.0, 1.0};
inline constexpr Range<double> kOutlineWidthRange{"outline_width", 0.0005, 0.01};
inline constexpr Range<double> kBloomThresholdRange{"bloom_threshold", 0.0, 1'000.0};
inline constexpr Range<double> kBloomKneeRange{"bloom_knee", 0.0, 1.0};
inline constexpr Range<double> kBloomStrengthRange{"bloom_strength", 0.0, 1.0};
inline constexpr Range<double> kBloomRadiusRange{"bloom_radius", 0.001, 0.05};
inline constexpr Range<uint32_t> kPlacedIdRange{"lights.id", 1, 0xffffffff};
// All of them are told to whoever joins: some 200 KB.
inline constexpr Range<uint32_t> kPlacedCountRange{"placed_lights", 0, 2048};
inline constexpr Range<double> kPlacedColorRange{"lights.color", 0.0, 1.0};
inline constexpr Range<double> kConeRange{"lights.cone_deg", 0.0, 90.0};     // half angles
inline constexpr Range<double> kAreaSideRange{"lights.side_m", 0.01, 100.0}; // of a rectangle
inline constexpr Range<double> kRollRange{"lights.roll_deg", -360.0, 360.0};
inline constexpr Range<uint32_t> kReplacedRange{"lights.replaces", 0, 999'999};
inline constexpr Range<double> kPickRange{"pick", -1.0, 1.0};
inline constexpr Range<double> kFogDensityRange{"fog_density", 0.0, 100.0};
inline constexpr Range<double> kFogHeightFalloffRange{"fog_height_falloff", 0.0, 100.0};
inline constexpr Range<double> kFogBaseHeightRange{"fog_base_height", -1e7, 1e7};
inline constexpr Range<double> kFogAnisotropyRange{"fog_anisotropy", -0.95, 0.95};
inline constexpr Range<double> kFogAlbedoRange{"fog_albedo", 0.0, 1.0};
inline constexpr Range<uint32_t> kFogTileRange{"fog_tile", 4, 64};
inline constexpr Range<uint32_t> kFogSlicesRange{"fog_slices", 8, 256};
// 32 point lights of 512 take 201 MB a viewer.
inline constexpr Range<uint32_t> kShadowLightsRange{"shadow_lights", 0, 32};
inline constexpr Range<uint32_t> kShadowSizeRange{"shadow_size", 64, 512};
inline constexpr Range<double> kTimeRange{"time", 0.0, 1e9};

// Every range that a client can run into; the server tells them all when it greets.
inline constexpr std::tuple kCommandRanges{kWidthRange,
                                           kHeightRange,
                                           kLightCountRange,
                                           kLightRadiusRange,
                                           kLightIntensityRange,
                                           kLightSpeedRange,
                                           kAmbientRange,
                                           kGridXRange,
                                           kGridYRange,
                                           kGridZRange,
                                           kExposureRange,
                                           kFovRange,
                                           kHalfHeightRange,
                                           kPositionRange,
                                           kFocusRange,
                                           kUpRange,
                                           kQualityRange,
                                           kToonRange,
                                           kToonSlopeRange,
                                           kTimeRange,
                                           kLensShiftXRange,
                                           kLensShiftYRange,
                                           kLightCutoffRange,
                                           kTargetFpsRange,
                                           kVideoKbpsRange,
                                           kOutlineStrengthRange,
                                           kOutlineWidthRange,
                                           kBloomThresholdRange,
                                           kBloomKneeRange,
                                           kBloomStrengthRange,
                                           kBloomRadiusRange,
                                           kDebugScaleRange,
                                           kPeelLayersRange,
                                           kPlacedColorRange,
                                           kConeRange,
                                           kListCapRange,
                                           kFogDensityRange,
                                           kFogHeightFalloffRange,
                                           kFogBaseHeightRange,
                                           kFogAnisotropyRange,
                                           kFogAlbedoRange,
                                           kFogTileRange,
                                           kFogSlicesRange,
                                           kShadowLightsRange,
                                           kShadowSizeRange,
                                           kAreaSideRange,
                                           kRollRange,
                                           kReplacedRange,
                                           kPickRange};

} // namespace froxel::view
