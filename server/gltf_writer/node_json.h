// Placed things of a scene as glTF nodes.
#pragma once

#include "core/error.h"
#include "gltf_writer/binary_buffer.h"
#include "scene/scene.h"

namespace froxel::gltf_writer {

// Adds the instance's node to `nodes`. Errors: kScene for a transform that is not affine, not
// finite, or sheared.
[[nodiscard]] Result<void> addInstanceNode(const scene::Instance& instance, Json& nodes);

// The node refers to camera `index`.
[[nodiscard]] Json cameraNode(const scene::NamedCamera& camera, uint32_t index);
[[nodiscard]] Json cameraJson(const scene::NamedCamera& camera, const BoundsD3& scene_bounds);

// The node refers to light `index` of KHR_lights_punctual.
[[nodiscard]] Json lightNode(const scene::PunctualLight& light, uint32_t index);
[[nodiscard]] Json lightJson(const scene::PunctualLight& light);

inline constexpr const char* kLightsExtension = "KHR_lights_punctual";

} // namespace froxel::gltf_writer
