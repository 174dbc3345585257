// Set 2 of the visibility passes: the scene's geometry and materials, the frame's instances, draws.
#include "interface/meshlet_io.h"
#include "interface/visibility_io.h"
#include "lib/vertex_streams.glsl"

layout(set = 2, binding = 0, scalar) readonly buffer PositionBlock { vec3 positions[]; };
layout(set = 2, binding = 1, scalar) readonly buffer SurfaceBlock { SurfaceVertex surfaces[]; };
layout(set = 2, binding = 2, scalar) readonly buffer ExtendedBlock { ExtendedVertex extended[]; };
layout(set = 2, binding = 3, scalar) readonly buffer IndexBlock { uint indices[]; };
layout(set = 2, binding = 4, scalar) readonly buffer ItemBlock { VisibleItem items[]; };
layout(set = 2, binding = 5, scalar) readonly buffer PlacedBlock {
    PlacedMeshlet placed_meshlets[];
};
layout(set = 2, binding = 6, scalar) readonly buffer GroupBlock { MeshletGroup groups[]; };
layout(set = 2, binding = 7, scalar) readonly buffer MaterialsBlock { Material materials[]; };
layout(set = 2, binding = 8, scalar) readonly buffer InstanceBlock { InstanceView instances[]; };
layout(set = 2, binding = 22, scalar) readonly buffer MeshletBlock { Meshlet meshlets[]; };
