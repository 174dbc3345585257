// What a debug view needs of the host: pure functions of settings and facts.
#pragma once

#include "cluster/cluster_grid.h"
#include "core/frame_stats.h"
#include "core/math.h"
#include "interface/debug_io.h"
#include "light/frame_lights.h"
#include "settings/settings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::render {

// What the scales of heat maps are chosen from.
struct DebugFacts {
    uint32_t light_count = 0;
    bool lists = false;     // pixels loop over lists
    double list_length = 0; // then: lights that a pixel is expected to loop over
    uint32_t slice_count = 0;
    double farthest_m = 0; // depth of the scene
};

// The colours of a view in words, and its scale. A scale that is not given is a power of two, so
// that it seldom changes while a camera moves.
[[nodiscard]] DebugLegend makeLegend(const settings::Debug& debug, const DebugFacts& facts);

// Bytes of a texel that settings::showsGbuffer() shows; 0: the layout has no such target.
[[nodiscard]] uint32_t shownBytes(settings::DebugView view, uint32_t gbuffer_output_flags);

[[nodiscard]] io::DebugFrame makeDebugValues(const settings::ViewSettings& settings,
                                             const BoundsD3& scene_bounds_world,
                                             const DebugLegend& legend,
                                             uint32_t byte_count);

// Pairs of vertices in the camera's view space: the edges between the tiles of `grid`, from the eye
// of grid_camera on, in white, and the tiles of each slice's far plane in the slice's colour.
[[nodiscard]] std::vector<io::WireVertex> clusterWires(const cluster::ClusterGrid& grid,
                                                       const settings::Camera& grid_camera,
                                                       const settings::Camera& camera);

// Pixels that pairs of vertices cover as lines, about.
[[nodiscard]] double wirePixels(std::span<const io::WireVertex> wires,
                                const settings::Camera& camera,
                                const settings::Size& size);
// Likewise the three circles of each light, at most.
[[nodiscard]] double lightWirePixels(const light::FrameLights& lights,
                                     const settings::Camera& camera,
                                     const settings::Size& size);

// A frame's.
struct DebugFrame {
    io::DebugFrame values{};
    uint32_t light_count = 0;          // of light_spheres
    std::vector<io::WireVertex> wires; // of cluster_wires
    double wire_px = 0;                // that lines of either cover
    DebugLegend legend;
};

} // namespace froxel::render
