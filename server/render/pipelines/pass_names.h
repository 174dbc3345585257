// The label of each pass: of its timestamps and debug marker, of its price, and of whatever reports
// these. In the order of the frame.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace froxel::render {

namespace pass {

inline constexpr const char* kPose = "pose";
inline constexpr const char* kAssignLines = "assign_lines";
inline constexpr const char* kAssignCount = "assign_count";
inline constexpr const char* kAssignScan = "assign_scan";
inline constexpr const char* kAssignFill = "assign_fill";
inline constexpr const char* kAssignOrder = "assign_order";
inline constexpr const char* kShadows = "shadows";
inline constexpr const char* kDepthPrepass = "depth_prepass";
inline constexpr const char* kCull = "cull";
inline constexpr const char* kCompact = "compact";
inline constexpr const char* kVisibility = "visibility";
inline constexpr const char* kRasterClear = "raster_clear";
inline constexpr const char* kRasterMeshlets = "raster_meshlets";
inline constexpr const char* kRasterBlocks = "raster_blocks";
inline constexpr const char* kRasterFar = "raster_far";
inline constexpr const char* kRasterHidden = "raster_hidden";
inline constexpr const char* kRasterUnpack = "raster_unpack";
inline constexpr const char* kGbuffer = "gbuffer";
inline constexpr const char* kResolve = "resolve";
inline constexpr const char* kShade = "shade";
inline constexpr const char* kForward = "forward";
inline constexpr const char* kLighting = "lighting";
inline constexpr const char* kLayers = "layers";
inline constexpr const char* kToon = "toon";
inline constexpr const char* kOutline = "outline";
inline constexpr const char* kFragments = "fragments";
inline constexpr const char* kDebugView = "debug_view";
inline constexpr const char* kCountPairs = "count_pairs";
inline constexpr const char* kBackground = "background";
inline constexpr const char* kFogScatter = "fog_scatter";
inline constexpr const char* kFogIntegrate = "fog_integrate";
inline constexpr const char* kFog = "fog";
inline constexpr const char* kTransmissionDepth = "transmission_depth";
inline constexpr const char* kTransparentBehind = "transparent_behind";
inline constexpr const char* kBehind = "behind";
inline constexpr const char* kTransmission = "transmission";
inline constexpr const char* kTransparent = "transparent";
inline constexpr const char* kWeighted = "weighted";
inline constexpr const char* kPeel = "peel";
inline constexpr const char* kPeelCount = "peel_count";
inline constexpr const char* kBlendResolve = "blend_resolve";
inline constexpr const char* kBlendOverUnlit = "blend_over_unlit";
inline constexpr const char* kExposure = "exposure";
inline constexpr const char* kExposureMeter = "exposure_meter";
inline constexpr const char* kBloom = "bloom";
inline constexpr const char* kWires = "wires";
inline constexpr const char* kTonemap = "tonemap";
inline constexpr const char* kFxaa = "fxaa";
inline constexpr const char* kJpegBlocks = "jpeg_blocks";
inline constexpr const char* kJpegPlace = "jpeg_place";
inline constexpr const char* kJpegStuff = "jpeg_stuff";
inline constexpr const char* kPlanes = "planes";
inline constexpr const char* kReadback = "readback";
inline constexpr const char* kRadianceReadback = "radiance_readback";
inline constexpr const char* kLinearDepth = "linear_depth";
inline constexpr const char* kDepthMesh = "depth_mesh";

// A price alone: of all passes that make light lists on the device.
inline constexpr const char* kAssign = "assign";

} // namespace pass

// Passes whose time is part of another one's price.
struct PricedWith {
    std::string_view label;
    std::string_view price;
};
inline constexpr std::array kPricedWith = {PricedWith{pass::kAssignLines, pass::kAssign},
                                           PricedWith{pass::kAssignCount, pass::kAssign},
                                           PricedWith{pass::kAssignScan, pass::kAssign},
                                           PricedWith{pass::kAssignFill, pass::kAssign},
                                           PricedWith{pass::kAssignOrder, pass::kAssign},
                                           PricedWith{pass::kCull, pass::kVisibility},
                                           PricedWith{pass::kCompact, pass::kVisibility},
                                           PricedWith{pass::kRasterClear, pass::kVisibility},
                                           PricedWith{pass::kRasterMeshlets, pass::kVisibility},
                                           PricedWith{pass::kRasterBlocks, pass::kVisibility},
                                           PricedWith{pass::kRasterFar, pass::kVisibility},
                                           PricedWith{pass::kRasterHidden, pass::kVisibility},
                                           PricedWith{pass::kRasterUnpack, pass::kVisibility},
                                           PricedWith{pass::kFogIntegrate, pass::kFogScatter},
                                           PricedWith{pass::kWeighted, pass::kTransparent},
                                           PricedWith{pass::kPeelCount, pass::kPeel},
                                           PricedWith{pass::kExposureMeter, pass::kExposure},
                                           PricedWith{pass::kJpegPlace, pass::kJpegBlocks},
                                           PricedWith{pass::kJpegStuff, pass::kJpegBlocks}};

// The label of the price that holds the time of a pass.
[[nodiscard]] constexpr std::string_view priceOf(std::string_view label) {
    const auto* const with =
        std::ranges::find(kPricedWith, label, [](const PricedWith& row) { return row.label; });
    return with == kPricedWith.end() ? label : with->price;
}

} // namespace froxel::render
