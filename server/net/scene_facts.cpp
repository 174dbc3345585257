#include "net/scene_facts.h"

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

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

struct SeenNode {
    const session::PlacingNode* node = nullptr;
    uint64_t pixels = 0;
};

// By their pixels, most first. Those of instances that the scene lacks are its last node's.
std::vector<SeenNode> seenNodes(const session::SceneSummary& scene,
                                const still::CoveredPixels& pixels) {
    std::vector<SeenNode> seen;
    for (const auto& [instance, count] : pixels.of_instance) {
        const auto next = std::ranges::upper_bound(scene.nodes, instance, {},
                                                   &session::PlacingNode::first_instance);
        if (next == scene.nodes.begin()) {
            continue;
        }
        const session::PlacingNode* node = &*std::prev(next);
        if (seen.empty() || seen.back().node != node) {
            seen.push_back({node, 0});
        }
        seen.back().pixels += count;
    }
    std::ranges::stable_sort(seen, std::greater<>(), &SeenNode::pixels);
    return seen;
}

} // namespace

Json coverageOf(const session::SceneSummary& scene, const still::CoveredPixels& pixels) {
    constexpr size_t kMostListed = 100;
    const std::vector<SeenNode> seen = seenNodes(scene, pixels);
    uint64_t covered = 0;
    for (const auto& [instance, count] : pixels.of_instance) {
        covered += count;
    }
    Json nodes = Json::array();
    for (const SeenNode& of : seen | std::views::take(kMostListed)) {
        const uint32_t number = of.node->node;
        nodes.push_back({{"node", number == scene::kNone ? Json(nullptr) : Json(number)},
                         {"name", of.node->name},
                         {"pixels", of.pixels}});
    }
    const size_t left_out = seen.size() - nodes.size();
    return {{"covered", static_cast<double>(covered) / static_cast<double>(pixels.total)},
            {"nodes", std::move(nodes)},
            {"nodes_left_out", left_out}};
}

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
