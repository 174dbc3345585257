#include "app/scene_camera.h"

#include "core/text.h"
#include "motion/posed_scene.h"
#include "scene/enclosing_sphere.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace froxel::app {

namespace {

struct Finder {
    const scene::Scene& scene;
    const settings::Size& size;

    Result<settings::Camera> operator()(const DefaultCamera&) const {
        return firstViewOf(scene).cameraFor(size);
    }
    Result<settings::Camera> operator()(const settings::Camera& camera) const { return camera; }
    Result<settings::Camera> operator()(const std::string& name) const {
        const auto found = std::ranges::find(scene.cameras, name, &scene::NamedCamera::name);
        if (found != scene.cameras.end()) {
            return found->camera;
        }
        std::string names;
        for (const auto& camera : scene.cameras) {
            names += (names.empty() ? "" : ", ") + printable(camera.name);
        }
        return Error{ErrorCode::kInvalidArgument,
                     fmt::format("--camera: '{}' is no camera of this scene; it has {}",
                                 printable(name), names.empty() ? "none" : names)};
    }
};

// All that a pose and a view look at. Pixels take most of a scene's memory.
scene::Scene withoutImages(const scene::Scene& scene) {
    scene::Scene bare;
    bare.materials = scene.materials;
    bare.meshes = scene.meshes;
    bare.instances = scene.instances;
    bare.cameras = scene.cameras;
    bare.lights = scene.lights;
    bare.bounds_world = scene.bounds_world;
    bare.motion = scene.motion;
    return bare;
}

} // namespace

scene::FirstView firstViewOf(const scene::Scene& scene) {
    if (!scene.motion || !scene.cameras.empty()) {
        return scene::firstViewOf(scene, scene::enclosingSphere(scene));
    }
    const auto clips = motion::usualClips(*scene.motion);
    scene::Scene posed = motion::posedScene(withoutImages(scene), clips, 0);
    posed.bounds_world = motion::sampledBounds(scene, clips, 1);
    const settings::Sphere pose = scene::enclosingSphere(posed);
    // What unfolds later begins as a point.
    constexpr uint32_t kSamples = 8;
    constexpr double kLeast = 0.25;
    const BoundsD3 later = motion::sampledBounds(scene, clips, kSamples);
    const settings::Sphere whole{later.center(), 0.5 * glm::length(later.size())};
    return scene::firstViewOf(posed, pose.radius_m < kLeast * whole.radius_m ? whole : pose);
}

Result<settings::Camera>
findCamera(const CameraChoice& choice, const scene::Scene& scene, const settings::Size& size) {
    return std::visit(Finder{scene, size}, choice);
}

} // namespace froxel::app
