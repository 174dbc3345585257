// What one frame cost and how well its light lists fitted; the same names go to the protocol,
// the page, the metrics and the timing files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace froxel {

struct PassTime {
    std::string name; // the pass's debug label
    double gpu_us = 0;
};

struct LightListStats {
    uint32_t light_count = 0;       // point and spot lights assigned to the grid
    uint32_t cluster_count = 0;     // clusters in the grid
    uint32_t empty_count = 0;       // clusters with no light
    uint64_t entry_count = 0;       // light indices over all lists
    uint32_t largest = 0;           // longest list
    double mean = 0;                // entries per non-empty cluster
    bool overflowed = false;        // past their limit: every cluster names all lights
};

struct FrameStats {
    std::vector<PassTime> passes;   // in the order recorded
    double gpu_us = 0;              // first to last timestamp of the frame
    double host_us = 0;             // host work: culling, lights, assignment, recording
    double frame_us = 0;            // from submit call to readable pixels, on the host's clock
    uint32_t triangle_count = 0;    // triangles sent to the rasteriser
    uint32_t draw_count = 0;
    LightListStats lists;
};

} // namespace froxel
