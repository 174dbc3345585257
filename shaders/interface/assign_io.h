// What the light assignment on the device reads and leaves (scalar block layout).
#ifndef FROXEL_INTERFACE_ASSIGN_IO_H
#define FROXEL_INTERFACE_ASSIGN_IO_H

#include "assign_cone.h"
#include "assign_math.h"
#include "histogram_io.h"
#include "scan_io.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kAssignGroup = 64U;      // invocations of a workgroup that works on lights
FROXEL_CONST uint kAssignTaskLines = 8U;   // lines of a task, one an invocation
FROXEL_CONST uint kAssignScanGroup = 256U; // invocations of a workgroup that scans clusters
FROXEL_CONST uint kAssignScanEach = 8U;    // clusters an invocation
FROXEL_CONST uint kAssignScanBlock = 2048U;
FROXEL_CONST uint kAssignShortList = 2048U;   // up to here a list is sorted in shared memory
FROXEL_CONST uint kAssignBuckets = 256U;      // by runs of light indices
FROXEL_CONST uint kAssignWindowWords = 4096U; // of the bitmap that orders longer ones
FROXEL_CONST uint kAssignMaxGroups = 16384U;  // of a dispatch; more work is taken in turns

// What became of the frame's lists.
FROXEL_CONST uint kAssignLists = 0U;
FROXEL_CONST uint kAssignAllLights = 1U; // past max_entries: every cluster names one list of all
FROXEL_CONST uint kAssignShort = 2U;     // a buffer was too small: no lists, draw the frame again
FROXEL_CONST uint kAssignLong = 3U;      // pixels may loop over more than allowed: likewise
FROXEL_CONST uint kAssignMaxTiles = 16384U;
FROXEL_CONST uint kAssignMaxColumns = 128U;
FROXEL_CONST uint kAssignLineGroup = 512U; // invocations of a workgroup that makes a line of lists

// One frame's grid and limits. A table of doubles follows it in a buffer of its own: plane depths
// and their reciprocals (grid_z + 1 each; 0 for the eye), row edges and row norms (used_rows + 1
// each), column edges (used_columns + 1).
struct AssignFrame {
    PictureAxis columns;
    PictureAxis rows;
    uint grid_x;
    uint grid_y;
    uint grid_z;
    uint used_columns;
    uint used_rows;
    uint perspective;
    uint light_count;
    uint cluster_count;
    uint index_capacity; // at least light_count
    uint task_capacity;
    uint max_entries;
    // (Light, pixel) pairs that the frame may evaluate, each pixel counting with its tile's longest
    // list; 0: nobody asks, and tiles are not looked at.
    float max_pairs;
    uint max_list; // as long as one list may be, likewise
    uint image_width_px;
    uint image_height_px;
    uint tile_width_px;
    uint tile_height_px;
};

// A spot's volume, made on the host. Without a cut it is treated as a point light.
struct AssignSpot {
    Cone cone;
    Ball bound; // of cone and range, not dilated
    uint cut;
    uint padding0;
};

// Consecutive lines of the rectangle of slices and rows that a light's ball may meet.
struct AssignTask {
    uint light;
    uint corner; // first slice | first row << 9 | (rows - 1) << 16
    uint line;   // first one, within the rectangle
    uint end;    // of the rectangle
};
FROXEL_SIZE_ASSERT(AssignTask, 16);

struct AssignDispatch {
    uint x;
    uint y;
    uint z;
};

// Counters of a frame; the host reads them back, and behind them each tile's longest list.
struct AssignTotals {
    AssignDispatch tasks;
    AssignDispatch short_lists;
    AssignDispatch long_lists;
    uint task_count; // wanted, perhaps more than fit
    uint short_count;
    uint long_count;
    uint entry_count; // saturates at kScanSaturated
    uint largest;
    uint outcome;
    uint histogram[kHistogramBuckets]; // of list lengths
};

FROXEL_IO_NAMESPACE_END

#endif
