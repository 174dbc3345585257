// Light assignment of a small grid in one dispatch, a workgroup a line (a row of a slice). Each
// list has room for all lights, so nothing is counted first; lights are taken in their order, so
// nothing is sorted after.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"
#include "lib/assign_line.glsl"

layout(local_size_x = 512) in;
#include "lib/group_scan.glsl"

const uint kGroup = gl_WorkGroupSize.x;
const uint kChunkLights = 4096u;
const uint kChunkWords = kChunkLights / 32u;
// Of a light near the line: its place in the chunk, the first of its columns and the one past them.
const uint kPlaceBits = 12u;
const uint kColumnBits = 8u;

shared uint near_bits[kChunkWords]; // which of the chunk's lights may meet the line
shared uint near_before[kChunkWords];
shared uint near_lights[kChunkLights]; // those, in order
shared uint part_counts[kGroup];
shared uint list_counts[kAssignMaxColumns];

// In fp32 with slack beyond its rounding: may keep what misses, never loses what meets.
bool mayMeet(uint index, uint slice, uint row) {
    if (radius_bits[index] == 0x7f800000u) {
        return true;
    }
    Light light = lights[index];
    vec3 p = vec3(light.position_view.x, -light.position_view.y, -light.position_view.z);
    float radius = uintBitsToFloat(radius_bits[index]);
    if (light.spot != kNoSpot && spots[light.spot].cut != 0u) {
        Ball bound = spots[light.spot].bound;
        p = vec3(bound.x, bound.y, bound.z);
        radius = float(bound.radius);
    }
    radius += 4.0 * float(kAssignSlack) * (radius + abs(p.x) + abs(p.y) + abs(p.z));
    if (p.z - radius > float(planeDepth(slice + 1u)) || p.z + radius < float(planeDepth(slice))) {
        return false;
    }
    float y0 = float(rowEdge(row));
    float y1 = float(rowEdge(row + 1u));
    if (frame.perspective == 0u) {
        return !(p.y - radius > y1 || p.y + radius < y0);
    }
    return !(y0 * p.z - p.y > radius * float(rowNorm(row)) ||
             p.y - y1 * p.z > radius * float(rowNorm(row + 1u)));
}

// Fills near_lights with the chunk's lights that may meet the line; returns how many.
uint gatherNear(uint first_light, uint slice, uint row) {
    uint self = gl_LocalInvocationIndex;
    uint end = min(kChunkLights, frame.light_count - first_light);
    if (self < kChunkWords) {
        near_bits[self] = 0u;
    }
    barrier();
    for (uint i = self; i < end; i += kGroup) {
        if (mayMeet(first_light + i, slice, row)) {
            atomicOr(near_bits[i / 32u], 1u << (i % 32u));
        }
    }
    barrier();
    uint total;
    uint before = scanGroup(self < kChunkWords ? uint(bitCount(near_bits[self])) : 0u, total);
    if (self < kChunkWords) {
        near_before[self] = before;
    }
    barrier();
    for (uint i = self; i < end; i += kGroup) {
        uint bits = near_bits[i / 32u];
        uint bit = 1u << (i % 32u);
        if ((bits & bit) != 0u) {
            near_lights[near_before[i / 32u] + uint(bitCount(bits & (bit - 1u)))] = i;
        }
    }
    barrier();
    return total;
}

bool holdsColumn(uint near, uint column) {
    uint columns = near >> kPlaceBits;
    return column >= (columns & ((1u << kColumnBits) - 1u)) && column < columns >> kColumnBits;
}

// Appends the chunk's lights to the lists of the line. An invocation has one column and a part of
// the lights.
void appendNear(uint first_light, uint near_count, uint first_cluster) {
    uint self = gl_LocalInvocationIndex;
    uint parts = kGroup / frame.used_columns;
    uint column = self % frame.used_columns;
    uint part = self / frame.used_columns;
    uint first = part < parts ? near_count * part / parts : near_count;
    uint end = part < parts ? near_count * (part + 1u) / parts : near_count;
    uint count = 0u;
    for (uint k = first; k < end; ++k) {
        count += holdsColumn(near_lights[k], column) ? 1u : 0u;
    }
    part_counts[self] = count;
    barrier();
    uint at = (first_cluster + column) * frame.light_count + list_counts[column];
    for (uint i = column; i < self; i += frame.used_columns) {
        at += part_counts[i];
    }
    for (uint k = first; k < end; ++k) {
        uint near = near_lights[k];
        if (holdsColumn(near, column)) {
            indices[at++] = first_light + (near & (kChunkLights - 1u));
        }
    }
    barrier();
    if (part < parts) {
        atomicAdd(list_counts[column], count);
    }
    barrier();
}

void assignLine(uint slice, uint row, uint first_cluster) {
    for (uint first = 0u; first < frame.light_count; first += kChunkLights) {
        uint near_count = gatherNear(first, slice, row);
        for (uint k = gl_LocalInvocationIndex; k < near_count; k += kGroup) {
            uint place = near_lights[k];
            LightVolume volume = loadVolume(first + place);
            if (inSlice(volume, slice)) {
                Columns columns = columnsOf(volume, slice, row);
                if (columns.first <= columns.last) {
                    place |= uint(columns.first) << kPlaceBits | uint(columns.last + 1)
                                                                     << (kPlaceBits + kColumnBits);
                }
            }
            near_lights[k] = place;
        }
        barrier();
        appendNear(first, near_count, first_cluster);
    }
}

void main() {
    uint self = gl_LocalInvocationIndex;
    uint slice = gl_WorkGroupID.x / frame.grid_y;
    uint row = gl_WorkGroupID.x % frame.grid_y;
    uint first_cluster = gl_WorkGroupID.x * frame.grid_x;
    if (self < kAssignMaxColumns) {
        list_counts[self] = 0u;
    }
    barrier();
    if (row < frame.used_rows) {
        assignLine(slice, row, first_cluster);
    }
    if (self < frame.grid_x) {
        uint cluster = first_cluster + self;
        lists[cluster] = ClusterList(cluster * frame.light_count, list_counts[self]);
    }
}
