// A camera choice and a scene to a camera.
#pragma once

#include "app/value_parsers.h"
#include "scene/first_view.h"
#include "scene/scene.h"

#include <string>

namespace froxel::app {

// scene::firstViewOf() of the pose that plays at first.
[[nodiscard]] scene::FirstView firstViewOf(const scene::Scene& scene);

// size: of the pictures. Errors: kInvalidArgument, naming the camera asked for and those that the
// scene has.
[[nodiscard]] Result<settings::Camera>
findCamera(const CameraChoice& choice, const scene::Scene& scene, const settings::Size& size);

// What parseCamera() reads as a camera there; it keeps +Y up.
[[nodiscard]] std::string cameraText(const settings::Camera& camera);

} // namespace froxel::app
