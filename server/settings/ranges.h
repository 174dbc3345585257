// What is accepted of what is no setting (setting_rows.h), and of settings whose ranges others need
// too.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

namespace froxel::settings {

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
inline constexpr Range<double> kLightIntensityRange{"light_intensity", 0.0, 1e9};
inline constexpr Range<double> kSceneLightIntensityRange{"scene_light_intensity", 0.0, 1e9};
inline constexpr Range<uint32_t> kGridXRange{"grid.x", 1, 128};
inline constexpr Range<uint32_t> kGridYRange{"grid.y", 1, 128};
inline constexpr Range<uint32_t> kGridZRange{"grid.z", 1, 256};
inline constexpr Range<double> kFovRange{"fov_deg", 1.0, 170.0};
inline constexpr Range<double> kHalfHeightRange{"half_height", 0.0001, 1e7};
// Half pictures: enough for one of 64 x 64 tiles of a wall.
inline constexpr Range<double> kLensShiftXRange{"lens_shift.x", -64.0, 64.0};
inline constexpr Range<double> kLensShiftYRange{"lens_shift.y", -64.0, 64.0};
inline constexpr Range<double> kPositionRange{"position", -1e7, 1e7};
inline constexpr Range<double> kFocusRange{"focus", 1e-6, 1e8}; // from eye to target
inline constexpr Range<double> kUpRange{"up", 1e-6, 1e8};       // length of the up vector
inline constexpr Range<uint32_t> kQualityRange{"quality", 1, 100};
inline constexpr Range<uint32_t> kVideoKbpsRange{"video_kbps", 100, 100'000};
inline constexpr Range<uint32_t> kPeelLayersRange{"peel_layers", 1, 16};
inline constexpr Range<double> kToonRange{"toon", 0.0, 1.0};
inline constexpr Range<double> kToonSlopeRange{"toon.slope", -20.0, 20.0};
inline constexpr Range<uint32_t> kPlacedIdRange{"lights.id", 1, 0xffffffff};
// All of them are told to whoever joins: some 200 KB.
inline constexpr Range<uint32_t> kPlacedCountRange{"placed_lights", 0, 2048};
inline constexpr Range<double> kPlacedColorRange{"lights.color", 0.0, 1.0};
inline constexpr Range<double> kConeRange{"lights.cone_deg", 0.0, 90.0};     // half angles
inline constexpr Range<double> kAreaSideRange{"lights.side_m", 0.01, 100.0}; // of a rectangle
inline constexpr Range<double> kRollRange{"lights.roll_deg", -360.0, 360.0};
inline constexpr Range<uint32_t> kReplacedRange{"lights.replaces", 0, 999'999};
inline constexpr Range<double> kPickRange{"pick", -1.0, 1.0};
inline constexpr Range<double> kTimeRange{"time", 0.0, 1e9};
inline constexpr Range<double> kCompareSplitRange{"compare_split", 0.0, 1.0};

// Of what is no setting of the table: placed by hand, or of a camera, a size or a ramp.
inline constexpr std::tuple kOtherRanges{
    kWidthRange,       kHeightRange,      kGridXRange,      kGridYRange,       kGridZRange,
    kFovRange,         kHalfHeightRange,  kLensShiftXRange, kLensShiftYRange,  kPositionRange,
    kFocusRange,       kUpRange,          kToonRange,       kToonSlopeRange,   kPlacedIdRange,
    kPlacedCountRange, kPlacedColorRange, kConeRange,       kAreaSideRange,    kRollRange,
    kReplacedRange,    kPickRange,        kTimeRange,       kCompareSplitRange};

} // namespace froxel::settings
