#include "core/text.h"
#include "light/falloff.h"
#include "light/light_rig.h"
#include "light/seeded_lights.h"
#include "settings/ranges.h"

#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace froxel::light {
namespace {

// Where a point is in the picture: right and up of the middle, in half heights; infinity behind the
// eye.
class Finder {
  public:
    Finder(const settings::ViewSettings& settings, const glm::dvec2& at)
        : camera_(settings.camera),
          view_from_world_(glm::transpose(settings.camera.world_from_view)),
          half_height_(settings.camera.projection == settings::Projection::kPerspective
                           ? std::tan(settings.camera.yfov_rad / 2)
                           : settings.camera.half_height_m),
          at_((at + settings.camera.lens_shift) *
              glm::dvec2(static_cast<double>(settings.size.width_px) / settings.size.height_px,
                         1)) {}

    // From the place that was asked for.
    [[nodiscard]] double distanceTo(const glm::dvec3& position_world) const {
        const glm::dvec3 position = view_from_world_ * (position_world - camera_.eye_world);
        const double ahead_m = -position.z;
        if (!(ahead_m > camera_.near_m)) {
            return std::numeric_limits<double>::infinity();
        }
        const bool perspective = camera_.projection == settings::Projection::kPerspective;
        const double half_height_m = perspective ? ahead_m * half_height_ : half_height_;
        return glm::distance(glm::dvec2(position) / half_height_m, at_);
    }

  private:
    const settings::Camera& camera_;
    const glm::dmat3 view_from_world_;
    const double half_height_; // a metre ahead; metres of an orthographic one
    const glm::dvec2 at_;
};

Result<settings::PlacedLight> placedOf(const scene::PunctualLight& light) {
    settings::PlacedLight placed;
    placed.kind = light.type == scene::LightType::kSpot ? settings::LightKind::kSpot
                                                        : settings::LightKind::kPoint;
    placed.position_world = light.position_world;
    if (placed.kind == settings::LightKind::kSpot) {
        placed.direction_world = light.direction_world;
        placed.inner_cone_deg = glm::degrees(light.inner_cone_rad);
        placed.outer_cone_deg = glm::degrees(light.outer_cone_rad);
    }
    const float brightest = static_cast<float>(strongestChannel(light.color));
    if (brightest > 0) {
        placed.color = light.color / brightest;
    }
    placed.intensity = light.intensity * brightest;
    placed.radius_m = light.range_m;
    const auto refuse = [](const char* what, double value, const settings::Range<double>& range) {
        return Error{ErrorCode::kInvalidArgument,
                     std::string("hits a light whose ") + what + " is " + numberText(value) +
                         "; that of a placed light is from " + numberText(range.min) + " to " +
                         numberText(range.max)};
    };
    if (const double radius_m = static_cast<double>(placed.radius_m);
        !settings::kLightRadiusRange.contains(radius_m)) {
        return refuse("range", radius_m, settings::kLightRadiusRange);
    }
    for (const double coordinate :
         {placed.position_world.x, placed.position_world.y, placed.position_world.z}) {
        if (!settings::kPositionRange.contains(coordinate)) {
            return refuse("coordinate", coordinate, settings::kPositionRange);
        }
    }
    if (const double intensity = static_cast<double>(placed.intensity);
        !settings::kLightIntensityRange.contains(intensity)) {
        return refuse("intensity", intensity, settings::kLightIntensityRange);
    }
    return placed;
}

} // namespace

Result<settings::PlacedLight>
LightRig::pick(const settings::ViewSettings& settings, double time_s, const glm::dvec2& at) const {
    using Of = settings::LightRef::Of;
    const settings::Lights& lights = settings.lights;
    const size_t light_count = lights.count + (lights.scene_lights ? scene_lights_.size() : 0);
    if (light_count > kMostPickable) {
        return Error{ErrorCode::kInvalidArgument,
                     "belongs to a picture of " + numberText(light_count) +
                         " lights; picking works with at most " + numberText(kMostPickable)};
    }
    std::set<settings::LightRef> replaced;
    for (const settings::PlacedLight& light : lights.placed.lights()) {
        if (light.replaces) {
            replaced.insert(*light.replaces);
        }
    }
    const Finder finder(settings, at);
    double nearest = kPickReach;
    Result<settings::PlacedLight> found = Error{
        ErrorCode::kInvalidArgument, "hits no light; the centre of one must be within " +
                                         numberText(kPickReach) + " of half the picture's height"};
    // One that cannot be placed is told only where no other is.
    const auto offer = [&](const settings::LightRef& ref, const scene::PunctualLight& light) {
        const double distance = finder.distanceTo(light.position_world);
        if (distance > kPickReach || (found && distance > nearest) || replaced.contains(ref)) {
            return;
        }
        auto placed = placedOf(light);
        if (placed) {
            placed->replaces = ref;
            nearest = distance;
        }
        if (placed || !found) {
            found = std::move(placed);
        }
    };
    const auto seeded = seededLights(lights, seededSpace(lights), time_s);
    for (uint32_t i = 0; i < seeded.size(); ++i) {
        scene::PunctualLight light;
        light.position_world = seeded[i].position_world;
        light.color = seeded[i].color;
        light.range_m = lights.radius_m;
        offer({Of::kSeed, i}, light);
    }
    for (uint32_t i = 0; lights.scene_lights && i < scene_lights_.size(); ++i) {
        if (scene_lights_[i].type != scene::LightType::kDirectional) {
            offer({Of::kScene, i}, sceneLight(lights, i));
        }
    }
    return found;
}

} // namespace froxel::light
