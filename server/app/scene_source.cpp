#include "app/scene_source.h"

#include "app/value_parsers.h"
#include "builtin_scene/hall.h"
#include "core/text.h"
#include "gltf/gltf_loader.h"
#include "motion/posed_scene.h"
#include "scene/first_look.h"
#include "scene/motion.h"
#include "settings/setting_rows.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace froxel::app {

namespace {

constexpr const char* kBuiltin = "builtin";

// Of Motion::clips; scene::kNone: none plays.
Result<uint32_t> findAnimation(const std::string& wanted, const std::vector<scene::Clip>& clips) {
    const auto named = std::ranges::find(clips, wanted, &scene::Clip::name);
    if (named != clips.end()) {
        return static_cast<uint32_t>(named - clips.begin());
    }
    if (wanted == "none") {
        return scene::kNone;
    }
    const settings::Range<uint32_t> numbers{"", 1, static_cast<uint32_t>(clips.size())};
    if (const auto number = parseNumber(wanted, numbers)) {
        return *number - 1;
    }
    return Error{ErrorCode::kInvalidArgument,
                 fmt::format("--animation: '{}' is no animation of this scene; it has {}",
                             printable(wanted), scene::listOf(clips))};
}

Result<void> choose(const std::string& animation, scene::Scene& scene) {
    static const std::vector<scene::Clip> kNoClips;
    const auto found = findAnimation(animation, scene.motion ? scene.motion->clips : kNoClips);
    if (!found) {
        return found.error();
    }
    if (scene.motion) {
        auto motion = std::make_shared<scene::Motion>(*scene.motion);
        motion->played = *found;
        scene.motion = std::move(motion);
    }
    return {};
}

} // namespace

Result<scene::Scene> loadScene(const std::string& source, const std::string& animation) {
    auto scene =
        source == kBuiltin ? Result<scene::Scene>(builtin_scene::makeHall()) : gltf::load(source);
    if (!scene) {
        return scene;
    }
    if (!animation.empty()) {
        if (auto chosen = choose(animation, *scene); !chosen) {
            return chosen.error();
        }
    }
    if (scene->motion) {
        motion::placeCameras(*scene, motion::usualClips(*scene->motion), 0);
    }
    return scene;
}

settings::ViewSettings firstLook(const std::string& source,
                                 const scene::Scene& scene,
                                 const settings::ViewSettings& settings,
                                 const GivenSettings& given,
                                 const scene::Look* look,
                                 bool software) {
    settings::ViewSettings first = settings;
    if (!isBuiltin(source)) {
        scene::lookFor(scene, first);
    }
    if (look != nullptr) {
        look->apply(first, software);
    }
    for (const auto& row : settings::kSettingRows) {
        if (given.count(row.name) > 0) {
            row.set(first, row.get(settings));
        }
    }
    return first;
}

bool isBuiltin(const std::string& source) {
    return source == kBuiltin;
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
