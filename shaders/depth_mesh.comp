// The inverse distance along the view axis at each vertex of a mesh over the picture, in 1/m; 0
// where no solid surface is. Over a plane it is linear in the picture (McMillan 1997, "An
// Image-Based Approach to Three-Dimensional Computer Graphics"), so that the mesh is exact there.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "interface/depth_mesh_io.h"
#include "lib/frame.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

layout(set = 1, binding = 1) uniform texture2D depth_image;
layout(set = 2, binding = 0, scalar) writeonly buffer MeshBlock { float inverse_distances[]; };
layout(push_constant, scalar) uniform DepthMeshBlock { DepthMeshFrame mesh; };

// Depths that differ by more are of two surfaces: the vertex is the nearer one's, so that the mesh
// does not cut off its rim.
const float kSameSurface = 1.25;

float inverseDistance(ivec2 drawn) {
    float depth = texelFetch(depth_image, drawn, 0).x;
    return depth > 0.0 ? 1.0 / distanceFromDepth(depth) : 0.0;
}

// The mean over the samples of a pixel.
float atPixel(ivec2 pixel) {
    int count = int(mesh.samples);
    float sum = 0.0;
    for (int y = 0; y < count; ++y) {
        for (int x = 0; x < count; ++x) {
            sum += inverseDistance(pixel * count + ivec2(x, y));
        }
    }
    return sum / float(count * count);
}

void main() {
    uvec2 vertex = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(vertex, uvec2(mesh.columns, mesh.rows)))) {
        return;
    }
    ivec2 last = ivec2(frame.camera.width_px, frame.camera.height_px) / int(mesh.samples) - 1;
    ivec2 pixel = min(ivec2(vertex * mesh.cell_px), last);
    // Half a cell to each side, every second pixel.
    int reach = int(mesh.cell_px) / 2;
    float least = 1e30;
    float most = 0.0;
    for (int y = -reach; y <= reach; y += 2) {
        for (int x = -reach; x <= reach; x += 2) {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), last);
            float inverse = inverseDistance(at * int(mesh.samples));
            least = min(least, inverse);
            most = max(most, inverse);
        }
    }
    inverse_distances[vertex.y * mesh.columns + vertex.x] =
        most > kSameSurface * least ? most : atPixel(pixel);
}
