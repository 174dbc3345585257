#include "reference/lights.h"

#include "light/light_rig.h"
#include "light/seeded_lights.h"
#include "light/shadow_choice.h"
#include "reference/around.h"
#include "settings/environment.h"

#include <algorithm>
#include <cmath>

namespace froxel::reference {
namespace {

double squared(double x) {
    return x * x;
}

// KHR_lights_punctual: the falloff that its text recommends.
void addCone(const scene::PunctualLight& light, PointLight& out) {
    out.direction = glm::normalize(light.direction_world);
    const double cos_outer = std::cos(light.outer_cone_rad);
    out.cone_scale = 1 / std::max(0.001, std::cos(light.inner_cone_rad) - cos_outer);
    out.cone_offset = -cos_outer * out.cone_scale;
}

glm::dvec3 colorOf(const scene::PunctualLight& light) {
    return glm::dvec3(light.color) * static_cast<double>(light.intensity);
}

PointLight pointOf(const scene::PunctualLight& light, const glm::dvec3& eye) {
    PointLight point{.position = light.position_world - eye, .color = colorOf(light)};
    if (light.range_m > 0) {
        point.radius2 = squared(static_cast<double>(light.range_m));
    }
    if (light.type == scene::LightType::kSpot) {
        addCone(light, point);
        if (light.rectangle) {
            point.rectangle = {light.rectangle->half_right_world, light.rectangle->half_up_world};
            point.cone_scale = 1e30;
            point.cone_offset = 0;
        }
    }
    return point;
}

void addShadows(const light::LightRig& rig,
                const BoundsD3& bounds_world,
                const settings::ViewSettings& settings,
                double time_s,
                Lights& lights) {
    light::FrameLights frame;
    rig.evaluate(settings.lights, settings.camera, time_s, frame);
    for (const uint32_t i :
         light::chooseShadowed(frame, settings.camera, settings.size,
                               glm::length(bounds_world.size()), settings.shadows.light_count)) {
        lights.points[i].shadowed = true;
    }
}

Lights
unshadowed(const light::LightRig& rig, const settings::ViewSettings& settings, double time_s) {
    const glm::dvec3& eye = settings.camera.eye_world;
    Lights lights;
    const double seeded_radius = static_cast<double>(settings.lights.radius_m);
    for (const auto& seeded :
         light::seededLights(settings.lights, rig.seededSpace(settings.lights), time_s)) {
        lights.points.push_back({.position = seeded.position_world - eye,
                                 .radius2 = squared(seeded_radius),
                                 .color = glm::dvec3(seeded.color)});
    }
    light::LightRig::eachSeededStandIn(settings.lights,
                                       [&](uint32_t index, const scene::PunctualLight& light) {
                                           lights.points[index] = pointOf(light, eye);
                                       });
    const double ambient = static_cast<double>(settings.lights.ambient);
    lights.sky = glm::dvec3(settings::kAmbientSky) * ambient;
    lights.ground = glm::dvec3(settings::kAmbientGround) * ambient;
    rig.eachFixed(settings.lights, [&](const scene::PunctualLight& light) {
        if (light.type == scene::LightType::kDirectional) {
            lights.directionals.push_back({glm::normalize(light.direction_world), colorOf(light)});
            return;
        }
        lights.points.push_back(pointOf(light, eye));
    });
    return lights;
}

void addAround(const environment::Surroundings& seen,
               const settings::Environment& settings,
               Lights& lights) {
    const double rotation_rad = glm::radians(static_cast<double>(settings.rotation_deg));
    const auto strength = static_cast<double>(settings.strength);
    lights.around = Around{&seen, rotation_rad, strength,
                           environment::placed(seen.matt, rotation_rad, strength)};
    lights.sky = lights.ground = seen.mean() * strength;
}

} // namespace

Lights lightsAt(const scene::Scene& scene, const settings::ViewSettings& settings, double time_s) {
    const light::LightRig rig(scene);
    Lights lights = unshadowed(rig, settings, time_s);
    const double banded_m = light::mostBandedRadius(scene.bounds_world);
    for (PointLight& point : lights.points) {
        point.nearest_m = light::nearestDistance(scene.bounds_world);
        point.bands_middle = 9 / std::min(point.radius2, squared(banded_m));
    }
    if (const auto* seen = surroundingsFor(scene, settings.environment)) {
        addAround(*seen, settings.environment, lights);
    }
    if (settings.shadows.light_count > 0) {
        addShadows(rig, scene.bounds_world, settings, time_s, lights);
    }
    return lights;
}

} // namespace froxel::reference
