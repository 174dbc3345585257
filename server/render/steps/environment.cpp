#include "render/steps/environment.h"

#include "environment/panorama.h"
#include "interface/constants.h"
#include "render/frame/frame_context.h"
#include "render/frame/step.h"
#include "render/steps/order.h"

#include <glm/trigonometric.hpp>

#include <span>
#include <string>

namespace froxel::render {

namespace {

class Environment final : public Step {
  public:
    explicit Environment(SceneResources& scene) : scene_(scene) {}

    void addLoad(const UnitCosts& unit, CostInputs& load) const override {
        load.lit_pixel += onDevice(unit, kEnvironmentLookup);
    }
    void gather(FrameUpload& upload, FrameBlocks& blocks) override {
        blocks[io::kEnvironmentBinding] = {
            upload.add(std::span<const io::Environment>(&uniforms_, 1)), sizeof(uniforms_)};
        blocks[io::kLevelsBinding] = {.bytes = map_->texels.size_bytes,
                                      .buffer = *map_->texels.handle};
        const gpu::Buffer& lobes = scene_.stored<EnvironmentMaps>().lobes();
        blocks[io::kLobesBinding] = {.bytes = lobes.size_bytes, .buffer = *lobes.handle};
    }

  private:
    Result<void> build(const StepInputs& inputs, const FramePlan& /*frame*/) override {
        const auto& settings = inputs.settings;
        const auto map = scene_.stored<EnvironmentMaps>().find(settings.environment.light);
        if (!map) {
            return map.error();
        }
        map_ = *map;
        uniforms_ = makeEnvironment(settings.environment, settings.camera, map_->seen->matt);
        return {};
    }

    SceneResources& scene_;
    const EnvironmentMaps::Map* map_ = nullptr; // of the last frame that has it
    io::Environment uniforms_{};
};

std::optional<StepPlan> planOfEnvironment(const PlanInputs& inputs) {
    return hasEnvironment(inputs.settings)
               ? std::optional(StepPlan{.light_flags = io::kLightEnvironment})
               : std::nullopt;
}

std::string wordsOfEnvironment(const PlanInputs& inputs, const StepPlan* plan) {
    if (plan == nullptr) {
        return {};
    }
    const auto light = static_cast<size_t>(inputs.settings.environment.light);
    return "environment: " + std::string(settings::kEnvironmentLightNames[light]) +
           ", replaces the ambient light";
}

} // namespace

bool hasEnvironment(const settings::ViewSettings& settings) {
    return settings.environment.present() && !settings::replacesPicture(settings.debug.view);
}

io::Environment makeEnvironment(const settings::Environment& settings,
                                const settings::Camera& camera,
                                const environment::Diffuse& matt) {
    const double angle_rad = glm::radians(static_cast<double>(settings.rotation_deg));
    io::Environment out{};
    for (int axis = 0; axis < 3; ++axis) {
        out.map_from_view[axis] =
            glm::vec3(environment::turned(camera.world_from_view[axis], -angle_rad));
    }
    for (size_t i = 0; i < matt.terms.size(); ++i) {
        out.matt[i] = glm::vec3(matt.terms[i] * static_cast<double>(settings.strength));
    }
    out.strength = settings.strength;
    out.background_alpha = settings.blur * settings.blur;
    return out;
}

const StepRow kEnvironmentStep{.name = "environment",
                               .plan = planOfEnvironment,
                               .words = wordsOfEnvironment,
                               .make = makeStep<Environment>};

} // namespace froxel::render
