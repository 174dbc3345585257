// The visibility pass: what its ids name, and what culling reads (scalar block layout).
#ifndef FROXEL_INTERFACE_VISIBILITY_IO_H
#define FROXEL_INTERFACE_VISIBILITY_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// A pixel's id = (placed meshlet << kTriangleBits) | triangle of the meshlet.
FROXEL_CONST uint kTriangleBits = 7U;
FROXEL_CONST uint kCullGroup = 256U; // placed meshlets a workgroup of the culling passes
FROXEL_CONST uint kCulled = 0xffffffffU;
// Of a culling dispatch: whether nothing is culled, and whether meshlets have an order.
FROXEL_CONST uint kKeepAll = 1U;
FROXEL_CONST uint kOrdered = 2U;
FROXEL_CONST uint kAnyMaterial = 0xffffffffU;
// Of a dispatch that resolves ids: the last one of the frame also fills empty pixels; depths are
// those of planes already, kept from a frame before.
FROXEL_CONST uint kResolveLast = 1U;
FROXEL_CONST uint kResolveReused = 2U;
FROXEL_CONST uint kResolveLayers = 4U; // only surfaces that have layers
// Of one that shades a layer of surfaces that transmit light: only its tiles; and from this bit on
// its number, from the nearest.
FROXEL_CONST uint kResolveTiles = 8U;
FROXEL_CONST uint kResolveLayerShift = 8U;

// Before lists of layers' tiles (lib/layer_tiles.glsl): the words of a VkDispatchIndirectCommand
// and one of padding for each layer that there may be.
FROXEL_CONST uint kMostPeelLayers = 16U;
FROXEL_CONST uint kTileHeadWords = 4U * kMostPeelLayers;

// A primitive of an instance.
struct VisibleItem {
    uint instance;
    uint vertex_offset;
    uint material_index;
    uint flags;    // material flags
    uint textures; // a bit a slot
    uint draw_group;
    uint bends; // 1: the bounds of its meshlets say nothing
};
FROXEL_SIZE_ASSERT(VisibleItem, 28);

// A meshlet of an item. meshlet: kNoMeshlet fills up a workgroup. first_index: the meshlet's, at
// hand for those who have an id.
FROXEL_CONST uint kNoMeshlet = 0xffffffffU;
struct PlacedMeshlet {
    uint item;
    uint meshlet;
    uint first_index;
};
FROXEL_SIZE_ASSERT(PlacedMeshlet, 12);

// Meshlets drawn with one pipeline and material: a run of workgroups and of draw commands.
struct MeshletGroup {
    uint first_block;
    uint block_count;
};
FROXEL_SIZE_ASSERT(MeshletGroup, 8);

// An instance as this frame's camera sees it: view_from_object by rows; the eye in object space.
struct InstanceView {
    vec4 row0;
    vec4 row1;
    vec4 row2;
    vec3 eye_object;
    uint mirrored;
};
FROXEL_SIZE_ASSERT(InstanceView, 64);

// VkDrawIndexedIndirectCommand.
struct DrawCommand {
    uint index_count;
    uint instance_count;
    uint first_index;
    uint vertex_offset;
    uint first_instance;
};
FROXEL_SIZE_ASSERT(DrawCommand, 20);

FROXEL_IO_NAMESPACE_END

#endif
