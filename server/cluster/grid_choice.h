// The automatic grid, and whether lists pay at all: by what a frame would cost.
//
// A pixel of a cluster loops over the lights whose balls meet the cluster: as many, on average, as
// lie within the cluster grown by a ball (a Minkowski sum) at the lights' density. A light fills as
// many lists as clusters lie within such a body. Small clusters make short lists, many entries and
// subgroups of pixels that need several lists. Nothing here changes the picture.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/depth_range.h"
#include "cluster/light_spread.h"
#include "settings/settings.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace froxel::cluster {

// What work costs on a class of device, in nanoseconds of a frame's time.
struct GridCosts {
    double pair_ns;        // one light evaluated for one pixel
    double walk_ns;        // one more list for a pixel to walk, whatever its length
    double entry_ns;       // a light index found, written and uploaded
    double cluster_ns;     // a list's head
    double subgroup_width; // pixels side by side that walk each other's lists
    uint32_t few_lights;   // so many are as quickly looped over as assigned
};

// lavapipe 22.3 and the host's assigner, on two cores. A listed light that does not reach a
// subgroup is skipped there for a third of what it costs (3 ns) where it does.
inline constexpr GridCosts kCpuCosts{.pair_ns = 1,
                                     .walk_ns = 30,
                                     .entry_ns = 5,
                                     .cluster_ns = 10,
                                     .subgroup_width = 8,
                                     .few_lights = 16};
// H200, driver 580, 1920x1080, from 17 grids of 1,000 lights: a listed light that is skipped takes
// 0.1 us of 2 million pixels; 0.1 ms for an assignment in compute is the time of 24 lights that are
// not.
inline constexpr GridCosts kGpuCosts{.pair_ns = 0.00015,
                                     .walk_ns = 0.03,
                                     .entry_ns = 0.19,
                                     .cluster_ns = 0.2,
                                     .subgroup_width = 8,
                                     .few_lights = 24};

// The same where lights are added in the fragment stage, whose loops skip nothing: 0.37 ms for one
// more listed light.
inline constexpr GridCosts kGpuFragmentCosts{.pair_ns = 0.18,
                                             .walk_ns = 0.2,
                                             .entry_ns = 0.19,
                                             .cluster_ns = 0.2,
                                             .subgroup_width = 8,
                                             .few_lights = 2};

// What a choice is made by. `frustum` is any grid of the frame: its picture and edges count.
struct GridFacts {
    const ClusterGrid& frustum;
    DepthRange range;
    settings::GridLaw law = settings::GridLaw::kLogarithmic;
    const LightSpread& lights;
    GridCosts costs;
    // Where the picture's pixels lie, along the view axis; empty: by the square of an even
    // share of the range, as in rooms.
    std::span<const double> pixel_depths_m = {};
};

// Keep one a view, from frame to frame: a choice stands until another is a fifth cheaper.
struct GridMemory {
    uint32_t tile_px = 0; // 0: nothing was chosen yet
    uint32_t slices = 0;
    bool all_lights = false;
    bool operator==(const GridMemory&) const = default;
};

struct GridChoice {
    GridShape shape;
    GridMemory memory;      // for the next frame
    double list_length = 0; // expected, of a pixel
    std::string why = {};   // for a person
};

struct LoopChoice {
    bool all_lights = false;
    std::string why;
};

inline constexpr double kGridHysteresis = 1.2;
// An automatic grid takes at most this much for the heads of its lists, in each frame in flight.
inline constexpr uint64_t kAutomaticGridBytes = uint64_t{2} << 20U;

// Square tiles of a multiple of 8 pixels, and slices by facts.law. A pure function.
[[nodiscard]] GridChoice chooseGrid(const GridFacts& facts, const GridMemory& previous);

// The lights that a pixel is expected to loop over in a grid.
[[nodiscard]] double expectedListLength(const GridFacts& facts, const GridShape& shape);

// Lists, or all lights where lists of `list_length` cannot pay: few lights, or lists of about half
// of all lights. A pure function; previous.all_lights makes it keep to what it chose.
[[nodiscard]] LoopChoice
chooseLoop(const GridFacts& facts, double list_length, const GridMemory& previous);

} // namespace froxel::cluster
