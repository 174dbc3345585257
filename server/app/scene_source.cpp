#include "app/scene_source.h"

#include "builtin_scene/hall.h"
#include "core/text.h"
#include "gltf/gltf_loader.h"
#include "motion/posed_scene.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <utility>

namespace froxel::app {

namespace {

scene::Scene still(scene::Scene scene, double time_s) {
    const auto& clips = scene.motion->clips;
    if (!clips.empty()) {
        // With the gravest, which come first.
        scene.warnings.insert(
            scene.warnings.begin(),
            scene::Warning{
                "ANIMATION_NOT_PLAYED", scene::Severity::kWarning, "/animations",
                fmt::format(
                    "animations are not played: the first of {} is shown as it stands at {} s",
                    clips.size(), time_s)});
    }
    const auto usual = motion::usualClips(*scene.motion);
    return motion::posedScene(std::move(scene), usual, time_s);
}

} // namespace

Result<scene::Scene> loadScene(const std::string& source, double time_s) {
    if (source == "builtin") {
        return builtin_scene::makeHall();
    }
    auto scene = gltf::load(source);
    if (!scene || !scene->motion) {
        return scene;
    }
    return still(std::move(*scene), time_s);
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
