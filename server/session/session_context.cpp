#include "session/session_context.h"

#include "scene/motion.h"
#include "session/scene_port.h"

namespace froxel::session {

SceneContents contentsOf(const SceneSummary& scene) {
    return {.file_bytes = scene.file_bytes,
            .triangles = scene.triangle_count,
            .materials = scene.material_count,
            .textures = scene.texture_count,
            .lights = scene.punctual_light_count,
            .cameras = scene.cameras.size(),
            .animations = scene.motion ? scene.motion->clips.size() : 0};
}

SceneSummary summarize(const scene::Scene& scene) {
    SceneSummary summary;
    summary.name = scene.name;
    summary.file_bytes = scene.file_bytes;
    summary.material_count = static_cast<uint32_t>(scene.materials.size());
    summary.texture_count = static_cast<uint32_t>(scene.textures.size());
    summary.punctual_light_count = static_cast<uint32_t>(scene.lights.size());
    summary.cameras = scene.cameras;
    summary.material_variants = scene.material_variants;
    summary.material_variant = scene.material_variant;
    summary.bounds_world = scene.bounds_world;
    summary.motion = scene.motion;
    summary.extensions = scene.extensions;
    summary.warnings = scene.warnings;
    summary.warnings_left_out = scene.warnings_left_out;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Instance& instance = scene.instances[i];
        if (i == 0 || instance.node == scene::kNone || instance.node != summary.nodes.back().node) {
            summary.nodes.push_back({static_cast<uint32_t>(i), instance.node, instance.name});
        }
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            summary.triangle_count += static_cast<uint32_t>(primitive.indices.size() / 3);
            ++summary.draw_count;
        }
    }
    return summary;
}

Result<settings::PlacedLight> pickNone(const settings::ViewSettings& /*settings*/,
                                       double /*time_s*/,
                                       const std::optional<motion::Playing>& /*playing*/,
                                       const glm::dvec2& /*at*/) {
    return Error{ErrorCode::kInvalidArgument, "hits no light"};
}

SessionDefaults defaultsFor(DeviceKind kind) {
    SessionDefaults defaults;
    defaults.delivery.refine = settings::Refine::kHigh;
    if (kind == DeviceKind::kCpu) {
        // A software rasteriser's time goes with the pixels: a quarter of 1080p stays interactive.
        defaults.settings.size = {640, 360};
        defaults.encoding.quality = 75;
        defaults.min_rate_hz = 5; // slower, a camera cannot be steered by what is seen
    } else {
        defaults.settings.size = {1280, 720};
        defaults.encoding.quality = 85;
        defaults.min_rate_hz = 30; // every second refresh of a usual display: still smooth
    }
    return defaults;
}

} // namespace froxel::session
