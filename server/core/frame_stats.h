// What one frame cost and how well its light lists fitted; the same names go to the protocol,
// the page, the metrics and the timing files.
#pragma once

#include "core/step_stats.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel {

struct PassTime {
    std::string name;             // the pass's debug label
    std::optional<double> gpu_us; // none: the driver wrote no timestamps
};

struct LightListStats {
    uint32_t light_count = 0;   // point and spot lights assigned to the grid
    uint32_t cluster_count = 0; // clusters in the grid
    uint32_t empty_count = 0;   // clusters with no light
    uint64_t entry_count = 0;   // light indices over all lists
    uint32_t largest = 0;       // longest list
    double mean = 0;            // entries per non-empty cluster
    uint32_t p95 = 0;           // 95 % of the non-empty lists are at most this long, in steps
                                // of a sixteenth
    uint64_t bytes = 0;         // of lists and light indices
    bool overflowed = false;    // past their limit: every cluster names all lights
    uint32_t redraw_count = 0;  // times the frame was drawn again since its lists had to grow
    // Where lists are capped: how many were cut, the entries that they lost, and what a surface
    // lacks at most in any one cluster, as irradiance in the strongest channel.
    uint32_t capped_count = 0;
    uint64_t dropped_count = 0;
    double dropped_irradiance = 0;
    bool all_lights = false; // no lists: every pixel loops over all lights
    std::string why;         // of all_lights, or of its opposite
};

// The cluster grid of a frame; x of 0: none.
struct GridStats {
    uint32_t x = 0;
    uint32_t y = 0;
    uint32_t z = 0;
    uint32_t tile_width_px = 0;
    uint32_t tile_height_px = 0;
    double near_m = 0; // slice 0 reaches from the eye to the first plane beyond this
    double far_m = 0;
    bool automatic = false;
    std::string why; // how the automatic grid was chosen, for a person
};

struct MemoryUse {
    std::string purpose;
    uint64_t bytes = 0;
};

// How to read a debug view.
struct DebugLegend {
    std::string view;  // settings::kDebugViewNames
    std::string words; // what its colours say, for a person
    double min = 0;    // of a heat map's scale; the top stands for more, too
    double max = 0;
    std::string unit;
    std::vector<uint32_t> colors; // of the scale, evenly spaced, 0xRRGGBB; empty: no heat map
    bool operator==(const DebugLegend&) const = default;
};

// What seldom changes between frames: in words what the frame's variant leaves out and why, and
// where the device's memory goes.
struct FrameDetails {
    std::vector<std::string> plan;
    std::vector<MemoryUse> memory;
    std::optional<DebugLegend> legend;
};

struct FrameStats {
    std::vector<PassTime> passes; // in the order recorded
    std::optional<double> gpu_us; // first to last timestamp of the frame; none: not written
    double unpaced_us = 0;        // what it was to take of the device by unit costs of the start
    double host_us = 0;           // host work: culling, lights, assignment, recording
    double frame_us = 0;          // from submit call to readable pixels, on the host's clock
    bool surfaces_reused = false; // depth, ids and G-buffer are those of an earlier frame
    uint32_t triangle_count = 0;  // triangles sent to the rasteriser
    uint32_t draw_count = 0;
    LightListStats lists;
    GridStats grid;
    StepStats steps;
    std::shared_ptr<const FrameDetails> details; // another one only when something changed
};

} // namespace froxel
