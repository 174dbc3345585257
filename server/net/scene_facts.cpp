#include "net/scene_facts.h"

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <string>

namespace froxel::net {

using Json = nlohmann::ordered_json;

namespace {

Json jsonOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Json jsonOf(const BoundsD3& bounds) {
    if (bounds.empty()) {
        return nullptr;
    }
    return {{"min", jsonOf(bounds.min)},
            {"max", jsonOf(bounds.max)},
            {"size", jsonOf(bounds.max - bounds.min)}};
}

Json animationsOf(const session::SceneSummary& scene) {
    Json animations = Json::array();
    if (scene.motion) {
        for (const scene::Clip& clip : scene.motion->clips) {
            animations.push_back({{"name", clip.name}, {"seconds", clip.duration_s}});
        }
    }
    return animations;
}

// Those used, and of them those that are not read.
Json extensionsOf(const session::SceneSummary& scene) {
    Json used = Json::array();
    Json missing = Json::array();
    for (const scene::Extension& extension : scene.extensions) {
        used.push_back(extension.name);
        if (!extension.read) {
            missing.push_back(extension.name);
        }
    }
    return {{"used", std::move(used)}, {"missing", std::move(missing)}};
}

} // namespace

Json factsOf(const session::SceneSummary& scene) {
    Json cameras = Json::array();
    for (const scene::NamedCamera& camera : scene.cameras) {
        cameras.push_back(camera.name);
    }
    Json warnings = Json::array();
    for (const scene::Warning& warning : scene.warnings) {
        const bool grave = warning.severity == scene::Severity::kWarning;
        warnings.push_back({{"severity", grave ? "warning" : "info"},
                            {"code", warning.code},
                            {"pointer", warning.pointer},
                            {"message", warning.message}});
    }
    return {{"name", scene.name},
            {"file_bytes", scene.file_bytes},
            {"unit", "metre"},
            {"up", "+Y"},
            {"bounds", jsonOf(scene.bounds_world)},
            {"triangles", scene.triangle_count},
            {"draws", scene.draw_count},
            {"materials", scene.material_count},
            {"textures", scene.texture_count},
            {"lights", scene.punctual_light_count},
            {"cameras", std::move(cameras)},
            {"animations", animationsOf(scene)},
            {"material_variants", scene.material_variants},
            {"extensions", extensionsOf(scene)},
            {"warnings", std::move(warnings)},
            {"warnings_left_out", scene.warnings_left_out}};
}

} // namespace froxel::net
