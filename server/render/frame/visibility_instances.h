// Instances as one frame's camera sees them, for culling and shading on the device.
#pragma once

#include "interface/visibility_io.h"
#include "render/frame/draw_list.h"
#include "render/scene/visibility_scene.h"

#include <span>
#include <vector>

namespace froxel::render {

// rows: DrawList::rows of the same camera. Pure.
void placeInstances(std::span<const glm::dmat4> world_from_objects,
                    const settings::Camera& camera,
                    std::span<const InstanceRows> rows,
                    std::vector<io::InstanceView>& out);

// Indices of the placed meshlets, each group's near ones first: what lies behind is spared by the
// depth test. In buckets of distance, and in their own order inside one. None where
// VisibilityScene::ordered() says so. Pure.
void orderMeshlets(const VisibilityScene& visibility,
                   std::span<const Meshlet> meshlets,
                   std::span<const InstanceRows> rows,
                   std::vector<uint32_t>& order);

} // namespace froxel::render
