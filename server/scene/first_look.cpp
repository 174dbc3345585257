#include "scene/first_look.h"

#include "scene/enclosure.h"
#include "settings/ranges.h"

#include <algorithm>
#include <cmath>

namespace froxel::scene {

namespace {

// The one of 1, 2 and 5 times powers of ten that is nearest by ratio.
double roundNumber(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    const double lead = value / power; // [1, 10)
    return power * (lead < std::sqrt(2.0)    ? 1
                    : lead < std::sqrt(10.0) ? 2
                    : lead < std::sqrt(50.0) ? 5
                                             : 10);
}

bool allUnlit(const Scene& scene) {
    return std::all_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& material) { return material.unlit; });
}

double within(const settings::Range<double>& range, double value) {
    return std::clamp(value, range.min, range.max);
}

} // namespace

void lookFor(const Scene& scene, settings::ViewSettings& settings) {
    const double half_m = 0.5 * glm::length(scene.bounds_world.size());
    settings::Lights& lights = settings.lights;
    if (half_m > 0 && std::isfinite(half_m)) {
        const double usual_m = settings::Lights().radius_m;
        const double radius_m = within(settings::kLightRadiusRange, roundNumber(0.12 * half_m));
        lights.radius_m = static_cast<float>(radius_m);
        lights.intensity = static_cast<float>(
            within(settings::kLightIntensityRange, std::pow(radius_m / usual_m, 2)));
    }
    if (!scene.lights.empty()) {
        lights.count = 0;
        settings.exposure_mode = settings::ExposureMode::kFrame;
    } else if (!isRoom(scene)) {
        lights.count = 0;
        settings.environment.light = allUnlit(scene) ? settings::EnvironmentLight::kOff
                                                     : settings::EnvironmentLight::kStudio;
    }
}

} // namespace froxel::scene
