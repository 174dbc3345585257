#include "app/scene_source.h"

#include "app/value_parsers.h"
#include "bake/guest_files.h"
#include "builtin_scene/hall.h"
#include "core/text.h"
#include "gltf/gltf_loader.h"
#include "gltf/load_result.h"
#include "light/arriving_light.h"
#include "motion/posed_scene.h"
#include "scene/first_look.h"
#include "scene/motion.h"
#include "scene/name_list.h"
#include "scene/stacked_layers.h"
#include "settings/setting_rows.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace froxel::app {

namespace {

constexpr const char* kBuiltin = "builtin";
// A second of two cores at 1280x720.
constexpr uint64_t kMostGuestLayers = 1024;

// The place of a thing that is named, or numbered from 1, among those that there are; scene::kNone
// for "none".
Result<uint32_t> findByName(const std::string& wanted,
                            const std::vector<std::string>& names,
                            const char* option,
                            const char* what) {
    const auto named = std::ranges::find(names, wanted);
    if (named != names.end()) {
        return static_cast<uint32_t>(named - names.begin());
    }
    if (wanted == "none") {
        return scene::kNone;
    }
    const settings::Range<uint32_t> numbers{"", 1, static_cast<uint32_t>(names.size())};
    if (const auto number = parseNumber(wanted, numbers)) {
        return *number - 1;
    }
    return Error{ErrorCode::kInvalidArgument,
                 fmt::format("{}: '{}' names no {} of this scene; it has {}", option,
                             printable(wanted), what, scene::numberedList(names))};
}

Result<scene::Scene> makeHall(const ProgressReport& report) {
    if (!report({"building the hall", 0})) {
        return Error{ErrorCode::kCancelled, "the hall: cancelled, because nobody waits for it"};
    }
    return builtin_scene::makeHall();
}

Result<void> chooseAnimation(const std::string& wanted, scene::Scene& scene) {
    const auto names =
        scene.motion ? scene::namesOf(scene.motion->clips) : std::vector<std::string>();
    const auto found = findByName(wanted, names, "--animation", "animation");
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

Result<void> chooseMaterialVariant(const std::string& wanted, scene::Scene& scene) {
    const auto found =
        findByName(wanted, scene.material_variants, "--material-variant", "material variant");
    if (!found) {
        return found.error();
    }
    scene.material_variant = *found + 1; // kNone becomes 0
    return {};
}

void placeCameras(scene::Scene& scene) {
    if (scene.motion) {
        motion::placeCameras(scene, motion::usualClips(*scene.motion), 0);
    }
}

} // namespace

Result<scene::Scene> loadScene(const std::string& source,
                               const SceneChoices& choices,
                               const ProgressReport& report,
                               const SceneReading& reading) {
    auto scene = source == kBuiltin ? makeHall(report)
                                    : bake::load(source, reading.process, report, reading.limits);
    if (!scene) {
        return scene;
    }
    if (!choices.animation.empty()) {
        if (auto chosen = chooseAnimation(choices.animation, *scene); !chosen) {
            return chosen.error();
        }
    }
    if (!choices.material_variant.empty()) {
        if (auto chosen = chooseMaterialVariant(choices.material_variant, *scene); !chosen) {
            return chosen.error();
        }
    }
    placeCameras(*scene);
    return scene;
}

Result<scene::Scene> loadGuestScene(const std::shared_ptr<const guest::GuestScene>& brought,
                                    const ProgressReport& report,
                                    const SceneReading& reading) {
    bake::GuestFiles files(brought);
    auto scene = bake::loadFrom(files, brought->files.front().name, reading.process, report,
                                reading.limits.memory_bytes);
    if (!scene) {
        return scene;
    }
    if (const uint64_t layers = scene::stackedLayers(*scene); layers > kMostGuestLayers) {
        return gltf::sceneError(
            brought->files.front().name,
            fmt::format("about {} of its triangles lie over one another; a scene that a client "
                        "brings may have {}, because drawing more would stop everybody else",
                        layers, kMostGuestLayers));
    }
    placeCameras(*scene);
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
        scene::lookFor(scene, light::arrivingLight(scene), first);
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

settings::ViewSettings beginningOf(const std::string& source,
                                   const scene::Scene& scene,
                                   const settings::ViewSettings& settings,
                                   const GivenSettings& given,
                                   const ChosenLook& chosen,
                                   bool software) {
    const bool evening = isBuiltin(source) || scene::suitsEvening(scene);
    const scene::Look* look = chosen ? *chosen : evening ? scene::findLook("evening") : nullptr;
    settings::ViewSettings first = firstLook(source, scene, settings, given, look, software);
    // 27 us of 0.7 ms on an H100.
    if (!software && !chosen && look == nullptr && given.count("antialiasing") == 0) {
        first.antialiasing = settings::Antialiasing::kFxaa;
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
