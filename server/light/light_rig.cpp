#include "light/light_rig.h"

#include "core/assert.h"
#include "core/finite.h"
#include "light/light_cutoff.h"
#include "light/seeded_lights.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace froxel::light {
namespace {

// Farther than this a light adds less than 1e-30 of its intensity, and its squared distance would
// leave a float's range: it is put at this distance instead.
constexpr double kFarthest_m = 1e15;

// A rectangle shines ahead of its plane and not behind: a cone without a slope.
constexpr float kStep = 1e30F;

bool usable(const scene::PunctualLight& light) {
    const bool directed =
        light.type == scene::LightType::kPoint ||
        (isFinite(light.direction_world) && glm::length(light.direction_world) > 0);
    const bool coned = light.type != scene::LightType::kSpot ||
                       (std::isfinite(light.inner_cone_rad) && std::isfinite(light.outer_cone_rad));
    return isFinite(light.position_world) && isFinite(glm::dvec3(light.color)) &&
           std::isfinite(light.intensity) && light.range_m >= 0 && std::isfinite(light.range_m) &&
           directed && coned;
}

glm::vec3 scaledColor(const scene::PunctualLight& light) {
    const auto limit = static_cast<double>(std::numeric_limits<float>::max());
    const glm::dvec3 color = glm::dvec3(light.color) * static_cast<double>(light.intensity);
    return {glm::min(color, glm::dvec3(limit))};
}

glm::vec3 directionView(const scene::PunctualLight& light, const glm::dmat3& view_from_world) {
    return {glm::normalize(view_from_world * glm::normalize(light.direction_world))};
}

void addDirectional(const scene::PunctualLight& light,
                    const glm::dmat3& view_from_world,
                    FrameLights& out) {
    io::DirectionalLight directional{};
    directional.direction_view = directionView(light, view_from_world);
    directional.color = scaledColor(light);
    out.directionals.push_back(directional);
}

uint32_t addArea(const scene::LightRectangle& rectangle,
                 const glm::dmat3& view_from_world,
                 FrameLights& out) {
    const double area =
        4 * glm::length(rectangle.half_right_world) * glm::length(rectangle.half_up_world);
    out.areas.push_back({.half_right_view = view_from_world * rectangle.half_right_world,
                         .inv_area = static_cast<float>(1 / area),
                         .half_up_view = view_from_world * rectangle.half_up_world,
                         .padding0 = 0});
    return static_cast<uint32_t>(out.areas.size() - 1);
}

// Level, then rolled about the direction.
scene::LightRectangle rectangleOf(const settings::PlacedLight& placed) {
    const glm::dvec3 direction = glm::normalize(placed.direction_world);
    const glm::dvec3 side = glm::cross(direction, glm::dvec3(0, 1, 0));
    const glm::dvec3 level = glm::length(side) > 1e-6 ? glm::normalize(side) : glm::dvec3(1, 0, 0);
    const glm::dvec3 above = glm::cross(level, direction);
    const double roll = glm::radians(placed.roll_deg);
    const glm::dvec3 right = level * std::cos(roll) + above * std::sin(roll);
    return {right * (placed.width_m / 2), glm::cross(right, direction) * (placed.height_m / 2)};
}

// `index` is the light's own.
uint32_t addSpot(const scene::PunctualLight& light,
                 const glm::dmat3& view_from_world,
                 uint32_t index,
                 FrameLights& out) {
    const double cos_outer = std::cos(light.outer_cone_rad);
    const double scale = 1.0 / std::max(1e-3, std::cos(light.inner_cone_rad) - cos_outer);
    io::Spot spot{};
    spot.direction_view = directionView(light, view_from_world);
    spot.scale = static_cast<float>(scale);
    spot.offset = static_cast<float>(-cos_outer * scale);
    spot.area = io::kNoArea;
    if (light.rectangle) {
        spot.scale = kStep;
        spot.offset = 0;
        out.first_area = out.areas.empty() ? index : std::min(out.first_area, index);
        spot.area = addArea(*light.rectangle, view_from_world, out);
    }
    out.spots.push_back(spot);
    out.cones.push_back({cos_outer, std::sin(light.outer_cone_rad)});
    return static_cast<uint32_t>(out.spots.size() - 1);
}

void putLocal(const scene::PunctualLight& light,
              const settings::Camera& camera,
              const glm::dmat3& view_from_world,
              uint32_t index,
              FrameLights& out) {
    glm::dvec3 position = view_from_world * (light.position_world - camera.eye_world);
    const double distance = glm::length(position / kFarthest_m);
    if (distance > 1) {
        position /= distance;
    }
    const bool limited = light.range_m > 0;
    io::Light& local = out.lights[index];
    local.position_view = glm::vec3(position);
    local.inv_radius2 = limited ? inverseRadius2(static_cast<double>(light.range_m)) : 0.0F;
    local.color = scaledColor(light);
    local.spot = light.type == scene::LightType::kSpot ? addSpot(light, view_from_world, index, out)
                                                       : io::kNoSpot;
    out.radii_m[index] = limited ? light.range_m : std::numeric_limits<float>::infinity();
}

} // namespace

scene::PunctualLight asPunctual(const settings::PlacedLight& placed) {
    scene::PunctualLight light;
    const bool area = placed.kind == settings::LightKind::kArea;
    light.type = area || placed.kind == settings::LightKind::kSpot ? scene::LightType::kSpot
                                                                   : scene::LightType::kPoint;
    light.position_world = placed.position_world;
    light.direction_world = placed.direction_world;
    light.color = placed.color;
    light.intensity = placed.intensity;
    light.range_m = placed.radius_m;
    light.inner_cone_rad = glm::radians(placed.inner_cone_deg);
    light.outer_cone_rad = glm::radians(placed.outer_cone_deg);
    if (area) {
        light.inner_cone_rad = light.outer_cone_rad = std::numbers::pi / 2;
        light.rectangle = rectangleOf(placed);
    }
    return light;
}

bool standsForSeeded(const settings::Lights& settings, const settings::PlacedLight& placed) {
    return placed.replaces && placed.replaces->of == settings::LightRef::Of::kSeed &&
           placed.replaces->index < settings.count;
}

LightRig::LightRig(const scene::Scene& scene)
    : scene_bounds_world_(scene.bounds_world),
      places_(std::make_shared<const std::vector<LightPlace>>(lightPlaces(scene))) {
    for (uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (usable(scene.lights[i])) {
            scene_lights_.push_back(scene.lights[i]);
            scene_indices_.push_back(i);
        }
    }
}

void LightRig::place(uint32_t light,
                     const glm::dvec3& position_world,
                     const glm::dvec3& direction_world) {
    const auto found = std::lower_bound(scene_indices_.begin(), scene_indices_.end(), light);
    if (found != scene_indices_.end() && *found == light) {
        auto& placed = scene_lights_[static_cast<size_t>(found - scene_indices_.begin())];
        placed.position_world = position_world;
        placed.direction_world = direction_world;
    }
}

bool LightRig::standsForScene(const settings::Lights& settings,
                              const settings::PlacedLight& placed) const {
    return settings.scene_lights && placed.replaces &&
           placed.replaces->of == settings::LightRef::Of::kScene &&
           placed.replaces->index < scene_lights_.size() &&
           scene_lights_[placed.replaces->index].type != scene::LightType::kDirectional;
}

std::map<uint32_t, const settings::PlacedLight*>
LightRig::sceneStandIns(const settings::Lights& settings) const {
    std::map<uint32_t, const settings::PlacedLight*> stand_ins;
    for (const settings::PlacedLight& light : settings.placed.lights()) {
        if (standsForScene(settings, light)) {
            stand_ins.emplace(light.replaces->index, &light);
        }
    }
    return stand_ins;
}

SeededSpace LightRig::seededSpace(const settings::Lights& settings) const {
    const bool at_surfaces = settings.places == settings::LightPlaces::kSurfaces;
    if (settings.box) {
        return {*settings.box, at_surfaces ? placesIn(*settings.box) : nullptr};
    }
    BoundsD3 box = scene_bounds_world_;
    if (box.empty()) {
        box.add(glm::dvec3(0)); // nothing to light: any place will do
    }
    const glm::dvec3 margin = box.size() * kShrink;
    box.min += margin;
    box.max -= margin;
    return {box, at_surfaces ? places_ : nullptr};
}

LightRig::Places LightRig::placesIn(const BoundsD3& box_world) const {
    auto within = std::make_shared<std::vector<LightPlace>>();
    std::copy_if(places_->begin(), places_->end(), std::back_inserter(*within),
                 [&](const LightPlace& place) {
                     const glm::dvec3& at = place.position_world;
                     return glm::all(glm::greaterThanEqual(at, box_world.min)) &&
                            glm::all(glm::lessThanEqual(at, box_world.max));
                 });
    return within;
}

LightRig::Place
LightRig::placeOf(const settings::Lights& settings, double time_s, uint32_t index) const {
    std::optional<Place> found;
    const auto take = [&found](const scene::PunctualLight& light) {
        found.emplace().position_world = light.position_world;
        if (light.type == scene::LightType::kSpot) {
            found->direction_world = glm::normalize(light.direction_world);
            found->outer_cone_rad = light.outer_cone_rad;
        }
    };
    if (index < settings.count) {
        eachSeededStandIn(settings, [&](uint32_t of, const scene::PunctualLight& light) {
            if (of == index) {
                take(light);
            }
        });
        return found.value_or(
            Place{.position_world =
                      seededLight(settings, seededSpace(settings), time_s, index).position_world});
    }
    uint32_t at = settings.count;
    eachFixed(settings, [&](const scene::PunctualLight& light) {
        if (light.type != scene::LightType::kDirectional && at++ == index) {
            take(light);
        }
    });
    FROXEL_ASSERT(found, "no local light has this index");
    return *found;
}

void LightRig::evaluate(const settings::Lights& settings,
                        const settings::Camera& camera,
                        double time_s,
                        FrameLights& out) const {
    static_cast<void>(Evaluation(*this, settings, camera, time_s, out).advance(settings.count));
}

LightRig::Evaluation::Evaluation(const LightRig& rig,
                                 settings::Lights settings,
                                 const settings::Camera& camera,
                                 double time_s,
                                 FrameLights& out)
    : rig_(rig), settings_(std::move(settings)), camera_(camera), time_s_(time_s),
      space_(rig.seededSpace(settings_)), out_(out) {
    out.lights.resize(settings_.count);
    out.radii_m.assign(settings_.count, settings_.radius_m);
    out.spots.clear();
    out.cones.clear();
    out.areas.clear();
    out.directionals.clear();
    out.nearest_m = nearestDistance(rig.scene_bounds_world_);
    out.banded_radius_m = mostBandedRadius(rig.scene_bounds_world_);
}

bool LightRig::Evaluation::advance(uint32_t count) {
    const uint32_t end = done_ + std::min(count, settings_.count - done_);
    fillSeededLights(settings_, camera_, space_, time_s_, done_, end, out_.lights);
    done_ = end;
    if (done_ < settings_.count) {
        return false;
    }
    finish();
    return true;
}

// What is not seeded.
void LightRig::Evaluation::finish() {
    const glm::dmat3 view_from_world = glm::transpose(camera_.world_from_view);
    eachSeededStandIn(settings_, [&](uint32_t index, const scene::PunctualLight& light) {
        putLocal(light, camera_, view_from_world, index, out_);
    });
    rig_.eachFixed(settings_, [&](const scene::PunctualLight& light) {
        if (light.type == scene::LightType::kDirectional) {
            addDirectional(light, view_from_world, out_);
            return;
        }
        const auto index = static_cast<uint32_t>(out_.lights.size());
        out_.lights.emplace_back();
        out_.radii_m.emplace_back();
        putLocal(light, camera_, view_from_world, index, out_);
    });
    if (settings_.cutoff > 0) {
        cutLights(out_, static_cast<double>(settings_.cutoff), settings_.cutoff_compensated);
    }
}

} // namespace froxel::light
