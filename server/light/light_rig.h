// The lights of a frame, as a pure function of scene, settings, camera and time.
#pragma once

#include "core/error.h"
#include "core/math.h"
#include "light/frame_lights.h"
#include "light/seeded_lights.h"
#include "scene/scene.h"
#include "settings/camera.h"
#include "settings/settings.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace froxel::light {

[[nodiscard]] scene::PunctualLight asPunctual(const settings::PlacedLight& placed);

// Whether it takes the place of a seeded light that is there.
[[nodiscard]] bool standsForSeeded(const settings::Lights& settings,
                                   const settings::PlacedLight& placed);

// Any number of threads may evaluate at once, each into its own FrameLights.
class LightRig {
  public:
    // Copies what it needs. A scene light whose position, direction, colour or cone is not finite,
    // or whose range is negative, is left out (the loader reports it): no frame holds a NaN.
    explicit LightRig(const scene::Scene& scene);

    // Puts a light of Scene::lights elsewhere, while nobody evaluates. All numbers are finite, the
    // direction is unit. A light that was left out stays out.
    void place(uint32_t light, const glm::dvec3& position_world, const glm::dvec3& direction_world);

    // Replaces the contents of `out`. `time_s` is the lights' clock: whoever owns it
    // folds speed and pauses in. Positions are subtracted from the eye and rotated in double, then
    // rounded once to float.
    void evaluate(const settings::Lights& settings,
                  const settings::Camera& camera,
                  double time_s,
                  FrameLights& out) const;

    // The same in parts. `rig` and `out` outlive it, and are left alone meanwhile.
    class Evaluation {
      public:
        Evaluation(const LightRig& rig,
                   settings::Lights settings,
                   const settings::Camera& camera,
                   double time_s,
                   FrameLights& out);
        // Does so many of the seeded lights more; whether all is done.
        [[nodiscard]] bool advance(uint32_t count);

      private:
        void finish();

        const LightRig& rig_;
        const settings::Lights settings_;
        const settings::Camera camera_;
        const double time_s_;
        const SeededSpace space_;
        FrameLights& out_;
        uint32_t done_ = 0;
    };

    // Where the local light of an index of FrameLights::lights is, whatever the camera. `index` is
    // below their number.
    struct Place {
        glm::dvec3 position_world{0};
        glm::dvec3 direction_world{0};                       // unit, the way it shines; spots only
        std::optional<double> outer_cone_rad = std::nullopt; // half angle; none: a point light
    };
    [[nodiscard]] Place
    placeOf(const settings::Lights& settings, double time_s, uint32_t index) const;

    // The seeded or scene light with the middle nearest to `at`, right and up of the picture's own
    // in half pictures, as a placed light that stands for it. Errors: kInvalidArgument, the end of
    // a sentence: none within kPickReach, one that cannot be placed, more than kMostPickable.
    [[nodiscard]] Result<settings::PlacedLight>
    pick(const settings::ViewSettings& settings, double time_s, const glm::dvec2& at) const;
    static constexpr double kPickReach = 0.05; // of half the picture's height
    static constexpr uint32_t kMostPickable = 20'000;

    // The box that seeded lights move in, metres in world space: the settings' own, or the scene's
    // bounds less kShrink of their size on every side. Where they hover at surfaces, those in the
    // settings' own box if there is one; where none is, they move in the box.
    [[nodiscard]] SeededSpace seededSpace(const settings::Lights& settings) const;

    // Calls visit(const scene::PunctualLight&) for the lights of a frame that are not seeded, in
    // their order: the scene's, as its file has them, or who stands for them, then the others that
    // viewers placed, by id.
    template <class Visit>
    void eachFixed(const settings::Lights& settings, const Visit& visit) const {
        const auto stand_ins = sceneStandIns(settings);
        auto next = stand_ins.begin();
        for (uint32_t i = 0; settings.scene_lights && i < scene_lights_.size(); ++i) {
            if (next != stand_ins.end() && next->first == i) {
                visit(asPunctual(*next->second));
                ++next;
            } else {
                visit(sceneLight(settings, i));
            }
        }
        for (const settings::PlacedLight& light : settings.placed.lights()) {
            if (!standsForSeeded(settings, light) && !standsForScene(settings, light)) {
                visit(asPunctual(light));
            }
        }
    }

    // Calls visit(index, const scene::PunctualLight&) for the seeded lights that a placed one
    // stands for.
    template <class Visit>
    static void eachSeededStandIn(const settings::Lights& settings, const Visit& visit) {
        for (const settings::PlacedLight& light : settings.placed.lights()) {
            if (standsForSeeded(settings, light)) {
                visit(light.replaces->index, asPunctual(light));
            }
        }
    }

    static constexpr double kShrink = 0.04;

  private:
    using Places = std::shared_ptr<const std::vector<LightPlace>>;
    [[nodiscard]] Places placesIn(const BoundsD3& box_world) const;
    // As bright as the settings have it; `index` is of scene_lights_.
    [[nodiscard]] scene::PunctualLight sceneLight(const settings::Lights& settings,
                                                  uint32_t index) const {
        scene::PunctualLight light = scene_lights_[index];
        const double intensity = static_cast<double>(light.intensity) *
                                 static_cast<double>(settings.scene_light_intensity);
        constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
        light.intensity = static_cast<float>(std::min(intensity, kMost));
        return light;
    }
    // Whether it takes the place of a scene light that is there.
    [[nodiscard]] bool standsForScene(const settings::Lights& settings,
                                      const settings::PlacedLight& placed) const;
    // For scene lights, by their index; alive as long as the settings.
    [[nodiscard]] std::map<uint32_t, const settings::PlacedLight*>
    sceneStandIns(const settings::Lights& settings) const;

    std::vector<scene::PunctualLight> scene_lights_;
    std::vector<uint32_t> scene_indices_; // of these in Scene::lights, rising
    BoundsD3 scene_bounds_world_;
    Places places_; // of the whole scene; its copies share them
};

} // namespace froxel::light
