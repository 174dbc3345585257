#include "app/scene_source.h"

#include "builtin_scene/hall.h"
#include "core/text.h"
#include "gltf/gltf_loader.h"
#include "motion/posed_scene.h"

#include <spdlog/spdlog.h>

namespace froxel::app {

Result<scene::Scene> loadScene(const std::string& source, double time_s) {
    if (source == "builtin") {
        return builtin_scene::makeHall();
    }
    auto scene = gltf::load(source);
    if (scene && scene->motion) {
        motion::placeCameras(*scene, motion::usualClips(*scene->motion), time_s);
    }
    return scene;
}

void logWarnings(const scene::Scene& scene) {
    for (const scene::Warning& warning : scene.warnings) {
        const auto level = warning.severity == scene::Severity::kWarning ? spdlog::level::warn
                                                                         : spdlog::level::info;
        spdlog::log(level, "event=scene_warning code={} pointer={} text={}", warning.code,
                    logValue(warning.pointer), logValue(warning.message, 400));
    }
    if (scene.warnings_left_out > 0) {
        spdlog::warn("event=scene_warnings_left_out count={}", scene.warnings_left_out);
    }
}

} // namespace froxel::app
