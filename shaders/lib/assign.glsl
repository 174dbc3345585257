// Set 0 of the light assignment on the device. Every shader of it includes this.
#include "lib/assign_round.glsl"
#include "interface/assign_io.h"
#include "interface/light_io.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBlock { AssignFrame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer TableBlock { double tables[]; };
layout(set = 0, binding = 2, scalar) readonly buffer LightBlock { Light lights[]; };
layout(set = 0, binding = 3, scalar) readonly buffer RadiusBlock { uint radius_bits[]; };
layout(set = 0, binding = 4, scalar) readonly buffer SpotBlock { AssignSpot spots[]; };
layout(set = 0, binding = 5, scalar) buffer TotalsBlock {
    AssignTotals totals;
    uint tile_longest[]; // row by row; of frames with max_pairs
};
layout(set = 0, binding = 6, scalar) buffer TaskBlock { AssignTask tasks[]; };
layout(set = 0, binding = 7, scalar) buffer SpanBlock { uint spans[]; }; // a task's, by line
// Of each cluster: first its count, then where its next entry goes.
layout(set = 0, binding = 8, scalar) buffer CursorBlock { uint cursors[]; };
layout(set = 0, binding = 9, scalar) buffer SumBlock { uint block_sums[]; };
// Clusters whose list is to be ordered: short ones from the front, long ones from the back.
layout(set = 0, binding = 10, scalar) buffer QueueBlock { uint queue[]; };
layout(set = 0, binding = 11, scalar) buffer ListBlock { ClusterList lists[]; };
layout(set = 0, binding = 12, scalar) buffer RawBlock { uint raw_indices[]; }; // in any order
layout(set = 0, binding = 13, scalar) buffer IndexBlock { uint indices[]; };

double planeDepth(uint k) { return tables[k]; }
double planeInverse(uint k) { return tables[frame.grid_z + 1u + k]; }
double rowEdge(uint j) { return tables[2u * (frame.grid_z + 1u) + j]; }
double rowNorm(uint j) { return tables[2u * (frame.grid_z + 1u) + frame.used_rows + 1u + j]; }
double columnEdge(uint i) {
    return tables[2u * (frame.grid_z + 1u) + 2u * (frame.used_rows + 1u) + i];
}

struct LightVolume {
    Ball ball;      // dilated
    bool unlimited; // no ball
    bool cut;       // by spots[spot].cone
    uint spot;
};

LightVolume loadVolume(uint index) {
    Light light = lights[index];
    LightVolume volume;
    volume.spot = light.spot;
    volume.cut = light.spot != kNoSpot && spots[light.spot].cut != 0u;
    volume.unlimited = radius_bits[index] == 0x7f800000u;
    vec3 p = light.position_view;
    Ball ball = Ball(double(p.x), double(-p.y), double(-p.z),
                     double(uintBitsToFloat(volume.unlimited ? 0u : radius_bits[index])));
    if (volume.cut) {
        ball = spots[light.spot].bound;
    }
    ball.radius = dilatedRadius(ball);
    volume.ball = ball;
    return volume;
}
