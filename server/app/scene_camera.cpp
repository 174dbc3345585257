#include "app/scene_camera.h"

#include "core/text.h"
#include "motion/posed_scene.h"
#include "scene/enclosing_sphere.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

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
                     fmt::format("--camera: '{}' is not a camera of this scene; it has {}",
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

// Of a clip, after its first: what it shows over its length is to be in the picture.
constexpr uint32_t kMoments = 7;
// Of all moments together, that are posed: a second or two.
constexpr uint64_t kMostVertices = uint64_t{1} << 24U;

uint64_t vertexCount(const scene::Scene& scene) {
    uint64_t count = 0;
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            count += primitive.positions.size();
        }
    }
    return count;
}

// As the clips have it at that time; its bounds are of that alone.
scene::Scene
momentOf(const scene::Scene& scene, std::span<const motion::PlayedClip> clips, double time_s) {
    scene::Scene posed = motion::posedScene(scene, clips, time_s);
    posed.bounds_world = {};
    for (const scene::Instance& instance : posed.instances) {
        for (const scene::Primitive& primitive : posed.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                posed.bounds_world.add(
                    glm::dvec3(instance.world_from_object * glm::dvec4(position, 1)));
            }
        }
    }
    return posed;
}

// About both; `a` where that holds the other.
settings::Sphere together(const settings::Sphere& a, const settings::Sphere& b) {
    const double apart_m = glm::distance(a.center, b.center);
    if (apart_m + b.radius_m <= a.radius_m) {
        return a;
    }
    if (apart_m + a.radius_m <= b.radius_m) {
        return b;
    }
    const double radius_m = 0.5 * (apart_m + a.radius_m + b.radius_m);
    return {glm::mix(a.center, b.center, (radius_m - a.radius_m) / apart_m), radius_m};
}

} // namespace

scene::FirstView firstViewOf(const scene::Scene& scene) {
    if (!scene.motion || !scene.cameras.empty()) {
        return scene::firstViewOf(scene, scene::enclosingSphere(scene));
    }
    const auto clips = motion::usualClips(*scene.motion);
    double duration_s = 0;
    for (const auto& played : clips) {
        duration_s = std::max(duration_s, scene.motion->clips[played.clip].duration_s);
    }
    const scene::Scene bare = withoutImages(scene);
    const scene::Scene first = momentOf(bare, clips, 0);
    settings::Sphere sphere = scene::enclosingSphere(first);
    const auto moments =
        static_cast<uint32_t>(std::clamp(kMostVertices / std::max(vertexCount(scene), uint64_t{1}),
                                         uint64_t{1}, uint64_t{kMoments}));
    for (uint32_t i = 1; i <= moments; ++i) {
        sphere = together(sphere,
                          scene::enclosingSphere(momentOf(bare, clips, duration_s * i / moments)));
    }
    return scene::firstViewOf(first, sphere);
}

Result<settings::Camera>
findCamera(const CameraChoice& choice, const scene::Scene& scene, const settings::Size& size) {
    return std::visit(Finder{scene, size}, choice);
}

std::string cameraText(const settings::Camera& camera) {
    // A billionth of a millimetre is what sines leave of 0.
    const auto number = [](double value) {
        return fmt::format("{:.12g}", std::abs(value) < 1e-12 ? 0.0 : value);
    };
    const auto place = [&number](const glm::dvec3& at) {
        return number(at.x) + "," + number(at.y) + "," + number(at.z);
    };
    return place(camera.eye_world) + ";" + place(camera.target_world()) + ";" +
           number(glm::degrees(camera.yfov_rad));
}

} // namespace froxel::app
