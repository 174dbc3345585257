#include "render/effects/environment.h"

#include "environment/panorama.h"
#include "interface/constants.h"
#include "render/frame/effect.h"
#include "render/frame/frame_context.h"

#include <glm/trigonometric.hpp>

#include <span>
#include <string>

namespace froxel::render {

namespace {

// Of the frame set.

class Environment final : public Effect {
  public:
    explicit Environment(SceneResources& scene) : scene_(scene) {}

    Result<void> build(const EffectInputs& inputs, const EffectPlan& /*plan*/) override {
        const auto& settings = inputs.settings;
        const auto map = scene_.stored<EnvironmentMaps>().find(settings.environment.light);
        if (!map) {
            return map.error();
        }
        map_ = *map;
        uniforms_ = makeEnvironment(settings.environment, settings.camera, map_->seen->matt);
        return {};
    }
    void addLoad(const UnitCosts& unit, CostInputs& load) const override {
        load.lit_pixel += onDevice(unit, kEnvironmentLookup);
    }
    void addCosts(const FrameCosts& /*costs*/,
                  std::vector<PassEstimate>& /*passes*/) const override {}
    void gather(FrameUpload& upload, FrameBlocks& blocks) override {
        blocks[io::kEnvironmentBinding] = {
            upload.add(std::span<const io::Environment>(&uniforms_, 1)), sizeof(uniforms_)};
        blocks[io::kLevelsBinding] = {.bytes = map_->texels.size_bytes,
                                      .buffer = *map_->texels.handle};
        const gpu::Buffer& lobes = scene_.stored<EnvironmentMaps>().lobes();
        blocks[io::kLobesBinding] = {.bytes = lobes.size_bytes, .buffer = *lobes.handle};
    }

  private:
    SceneResources& scene_;
    const EnvironmentMaps::Map* map_ = nullptr; // of the last frame that has it
    io::Environment uniforms_{};
};

std::optional<EffectPlan> planOfEnvironment(const settings::ViewSettings& settings,
                                            const FrameFacts& /*facts*/) {
    return hasEnvironment(settings)
               ? std::optional(EffectPlan{.light_flags = io::kLightEnvironment})
               : std::nullopt;
}

std::string wordsOfEnvironment(const settings::ViewSettings& settings, const EffectPlan& /*plan*/) {
    const auto light = static_cast<size_t>(settings.environment.light);
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

const EffectRow kEnvironmentEffect{.place = EffectPlace::kLights,
                                   .plan = planOfEnvironment,
                                   .words = wordsOfEnvironment,
                                   .make = makeEffect<Environment>};

} // namespace froxel::render
