#include "app/scene_maker.h"

#include "app/environment_file.h"
#include "app/scene_camera.h"
#include "app/scene_source.h"
#include "light/light_rig.h"
#include "motion/pose.h"
#include "scene/looks.h"
#include "scene/motion.h"

#include <optional>
#include <utility>

namespace froxel::app {
namespace {

// Of all threads of the process that reads a scene that a client brought.
constexpr uint32_t kGuestCpu_s = 120;

// Lights are picked where they stand at the time.
session::LightPicker lightPicker(const scene::Scene& scene) {
    light::LightRig rig(scene);
    if (!scene.motion || scene.motion->lights.empty()) {
        return [rig = std::move(rig)](const auto& settings, double time_s, const auto& /*playing*/,
                                      const auto& at) { return rig.pick(settings, time_s, at); };
    }
    return [rig = std::move(rig), moved = scene.motion](
               const settings::ViewSettings& settings, double time_s,
               const std::optional<motion::Playing>& playing, const glm::dvec2& at) {
        motion::Pose pose;
        const motion::Playing none;
        const auto& [clips, now_s] = playing ? *playing : none;
        motion::pose(*moved, clips, now_s, pose);
        light::LightRig then = rig;
        motion::eachMovedLight(*moved, pose, [&](const auto&... light) { then.place(light...); });
        return then.pick(settings, time_s, at);
    };
}

} // namespace

SceneMaker::SceneMaker(const ServeOptions& options, const gpu::DeviceTraits& device)
    : options_(options), device_is_cpu_(device.is_cpu), device_name_(device.name),
      surroundings_(readSurroundings(options.environment_file)) {}

session::SessionDefaults SceneMaker::defaultsOf(const std::string& source,
                                                const scene::Scene& scene) const {
    auto defaults = session::defaultsFor(device_is_cpu_ ? session::DeviceKind::kCpu
                                                        : session::DeviceKind::kGpu);
    const settings::Size size = options_.size.value_or(defaults.settings.size);
    defaults.settings = beginningOf(source, scene, options_.first_view, options_.given,
                                    options_.look, device_is_cpu_);
    defaults.settings.size = size;
    defaults.encoding.quality = options_.quality.value_or(defaults.encoding.quality);
    defaults.min_rate_hz = options_.min_rate_hz.value_or(defaults.min_rate_hz);
    defaults.delivery = options_.delivery;
    defaults.lens_shift = options_.lens_shift;
    return defaults;
}

// Over what the scene begins with.
std::vector<session::OfferedLook> SceneMaker::looksOf(const std::string& source,
                                                      const scene::Scene& scene) const {
    const settings::ViewSettings usual = firstLook(source, scene, {}, {}, nullptr, device_is_cpu_);
    return session::offerLooks(usual, device_is_cpu_);
}

Result<stream::ReadScene> SceneMaker::make(const std::string& source,
                                           const SceneChoices& choices,
                                           const ProgressReport& report,
                                           const gltf::LoadLimits& limits) const {
    return finish(source,
                  loadScene(source, choices, report, {limits, {.sandbox = options_.sandbox}}));
}

Result<stream::ReadScene>
SceneMaker::makeGuest(const std::shared_ptr<const guest::GuestScene>& brought,
                      const ProgressReport& report,
                      uint64_t memory_bytes) const {
    return finish(brought->files.front().name,
                  loadGuestScene(brought, report,
                                 {.limits = {memory_bytes},

                                  .process = {.sandbox = options_.sandbox,
                                              .cpu_s = kGuestCpu_s,
                                              .form_boundary = brought->form_boundary}}));
}

Result<stream::ReadScene> SceneMaker::finish(const std::string& source,
                                             Result<scene::Scene> loaded) const {
    if (!loaded) {
        return loaded.error();
    }
    auto scene = std::make_shared<scene::Scene>(std::move(*loaded));
    surround(*scene, surroundings_);
    const scene::FirstView first_view = firstViewOf(*scene);
    if (first_view.remark) {
        scene->warnings.push_back(*first_view.remark);
    }
    logWarnings(*scene);
    session::SessionContext context{session::summarize(*scene),
                                    defaultsOf(source, *scene),
                                    FROXEL_VERSION,
                                    device_name_,
                                    lightPicker(*scene),
                                    first_view,
                                    looksOf(source, *scene)};
    context.scene.detail_levels = options_.detail_levels;
    return stream::ReadScene{std::move(scene), std::move(context)};
}

} // namespace froxel::app
