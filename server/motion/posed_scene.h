// A scene that moves as one that rests.
#pragma once

#include "motion/playback.h"
#include "motion/pose.h"
#include "scene/scene.h"

#include <span>

namespace froxel::motion {

// The scene as it stands at a time, without motion: meshes bent, instances, lights and cameras
// placed. Its bounds also hold what they held before. A light or camera whose node has no direction
// stays. A scene without motion comes back as it is.
[[nodiscard]] scene::Scene
posedScene(scene::Scene scene, std::span<const PlayedClip> clips, double time_s);

// Only its cameras.
void placeCameras(scene::Scene& scene, std::span<const PlayedClip> clips, double time_s);

// Whether a node moves this one of Scene::cameras.
[[nodiscard]] bool movesCamera(const scene::Motion& motion, uint32_t index);

// That camera where its node is; else as it is.
[[nodiscard]] settings::Camera cameraAt(const scene::Motion& motion,
                                        uint32_t index,
                                        const Playing& playing,
                                        settings::Camera camera);

} // namespace froxel::motion
