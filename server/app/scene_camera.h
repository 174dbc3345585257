// A camera choice and a scene to a camera.
#pragma once

#include "app/value_parsers.h"
#include "scene/scene.h"

namespace froxel::app {

// What a camera that nobody has chosen frames: scene::enclosingSphere(), or about what moves while
// it does.
[[nodiscard]] settings::Sphere framing(const scene::Scene& scene);

// size: of the pictures. Errors: kInvalidArgument, naming the camera asked for and those that the
// scene has.
[[nodiscard]] Result<settings::Camera>
findCamera(const CameraChoice& choice, const scene::Scene& scene, const settings::Size& size);

} // namespace froxel::app
