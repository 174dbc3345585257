#include "app/scene_camera.h"

#include "core/text.h"
#include "motion/posed_scene.h"
#include "scene/first_camera.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace froxel::app {

namespace {

struct Finder {
    const scene::Scene& scene;
    const settings::Size& size;

    Result<settings::Camera> operator()(const DefaultCamera&) const {
        return scene::firstCamera(scene.cameras, framing(scene), size);
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

} // namespace

settings::Sphere framing(const scene::Scene& scene) {
    constexpr uint32_t kSamples = 8;
    if (!scene.motion || !scene.cameras.empty()) {
        return scene::enclosingSphere(scene);
    }
    const BoundsD3 bounds =
        motion::sampledBounds(scene, motion::usualClips(*scene.motion), kSamples);
    return bounds.empty() ? settings::Sphere{}
                          : settings::Sphere{bounds.center(), glm::length(bounds.size()) / 2};
}

Result<settings::Camera>
findCamera(const CameraChoice& choice, const scene::Scene& scene, const settings::Size& size) {
    return std::visit(Finder{scene, size}, choice);
}

} // namespace froxel::app
