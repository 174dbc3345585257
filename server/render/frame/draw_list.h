// What of the scene goes to the rasteriser this frame: instances, meshlets and, where the device is
// a CPU, single triangles that cannot touch a pixel are left out. Never removes anything visible.
#pragma once

#include "gpu/vulkan.h"
#include "render/frame/frame_uniforms.h"
#include "render/frame/scene_pose.h"
#include "render/scene/scene_resources.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace froxel::render {

// view_from_object, row by row: an instance-rate vertex stream.
struct InstanceRows {
    glm::vec4 row[3];
};
static_assert(sizeof(InstanceRows) == 48);

// Draws of one material and winding: one indirect call.
struct DrawGroup {
    uint32_t material = 0;
    MaterialFlags material_flags = 0;
    bool mirrored = false;
    uint32_t first_command = 0;
    uint32_t command_count = 0;
};

// Of surfaces that what is behind shows through.
struct LayeredDraws {
    std::vector<DrawGroup> groups;
    uint32_t triangle_count = 0;
    std::vector<vk::Rect2D> parts; // of the picture, that hold a meshlet each
    // Those that hold what is seen through the meshlets: as they are, grown by their thickness.
    std::vector<vk::Rect2D> seen_parts;

    void clear() {
        groups.clear();
        triangle_count = 0;
        parts.clear();
        seen_parts.clear();
    }
};

// Keep one and build into it again: its buffers are reused.
struct DrawList {
    std::vector<InstanceRows> rows;                       // one for each instance
    std::vector<vk::DrawIndexedIndirectCommand> commands; // of all groups
    std::vector<DrawGroup> solid;                         // opaque and masked, near ones first
    LayeredDraws transparent;                             // blended ones, in the order asked for
    LayeredDraws transmissive;                            // in the order of the scene
    std::vector<uint32_t> indices; // culled by triangle; empty: commands index the scene's own
    std::vector<std::vector<uint32_t>> thread_indices; // scratch of the culling
    uint32_t triangle_count = 0;
};

// Of transparent surfaces: whole items from far to near, or all triangles as they stand in the
// scene, whatever the camera.
enum class TransparentOrder : uint8_t { kByDistance, kOfTheScene };

// by_triangle: also cull single triangles, into DrawList::indices; of what bends, whose vertices
// only the device knows, all. solid: false leaves out those. Pure.
void buildDrawList(const SceneResources& scene,
                   const ScenePose& pose,
                   const settings::Camera& camera,
                   const settings::Size& size,
                   const ViewProjection& projection,
                   float geometry_error_px,
                   bool by_triangle,
                   bool solid,
                   TransparentOrder order,
                   DrawList& out);

} // namespace froxel::render
