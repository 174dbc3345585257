// What `froxel info` says. One report serves both forms: JSON, and text for people.
#pragma once

#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace froxel::app {

//   name, triangles (drawn: each instance counts), draws, meshes, instances, materials, textures,
//   geometry_bytes and texture_bytes (as loaded, before packing and mip chains), cameras (names),
//   lights {point, spot, directional}, bounds_m {min, max} or null, needs (a line each), warnings
//   ({code, severity, pointer, message} each) and warnings_left_out
[[nodiscard]] nlohmann::ordered_json sceneReport(const scene::Scene& scene);

// Indented "key: value" lines; an object in a list is one line of its values.
[[nodiscard]] std::string toText(const nlohmann::ordered_json& report);

} // namespace froxel::app
