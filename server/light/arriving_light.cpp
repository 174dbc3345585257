#include "light/arriving_light.h"

#include "light/falloff.h"
#include "light/light_places.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace froxel::light {
namespace {

constexpr size_t kMostPairs = size_t{1} << 22U; // of places and lights
constexpr size_t kLeastPlaces = 64;

double brightnessOf(const scene::PunctualLight& light) {
    return luminanceOf(glm::dvec3(light.color)) * static_cast<double>(light.intensity);
}

double facing(const LightPlace& place, const glm::dvec3& to_light) {
    const double cosine = glm::dot(place.normal_world, to_light);
    return place.two_sided ? std::abs(cosine) : std::max(cosine, 0.0);
}

// Of a spot towards a point, as KHR_lights_punctual recommends.
double coneShare(const scene::PunctualLight& light, const glm::dvec3& to_light) {
    const double outer = std::cos(light.outer_cone_rad);
    const double scale = 1 / std::max(1e-3, std::cos(light.inner_cone_rad) - outer);
    const double towards = -glm::dot(glm::normalize(light.direction_world), to_light);
    const double share = std::clamp((towards - outer) * scale, 0.0, 1.0);
    return share * share;
}

// Not finite where the light is not.
double irradianceAt(const LightPlace& place, const scene::PunctualLight& light, double nearest_m) {
    if (light.type == scene::LightType::kDirectional) {
        return brightnessOf(light) * facing(place, -glm::normalize(light.direction_world));
    }
    const glm::dvec3 offset_m = light.position_world - place.position_world;
    const double distance_m = glm::length(offset_m);
    if (distance_m == 0) {
        return 0;
    }
    const glm::dvec3 to_light = offset_m / distance_m;
    const double of_range =
        light.range_m > 0 ? distance_m / static_cast<double>(light.range_m) : 0.0;
    const double window = std::pow(std::max(1 - std::pow(of_range, 4), 0.0), 2);
    const double cone = light.type == scene::LightType::kSpot ? coneShare(light, to_light) : 1.0;
    return brightnessOf(light) * window * cone * facing(place, to_light) /
           std::pow(std::max(distance_m, nearest_m), 2);
}

} // namespace

double arrivingLight(const scene::Scene& scene) {
    if (scene.lights.empty()) {
        return 0;
    }
    const std::vector<LightPlace> places = litPlaces(scene);
    const double nearest_m = nearestDistance(scene.bounds_world);
    // Places run through the scene in its order: each second, third, ... one is as even.
    const size_t wanted = std::max(kMostPairs / scene.lights.size(), kLeastPlaces);
    const size_t stride = 1 + places.size() / wanted;
    std::vector<double> irradiances;
    for (size_t i = 0; i < places.size(); i += stride) {
        double sum = 0;
        for (const scene::PunctualLight& light : scene.lights) {
            const double one = irradianceAt(places[i], light, nearest_m);
            sum += std::isfinite(one) ? std::max(one, 0.0) : 0.0; // a rig leaves it out
        }
        if (sum > 0 && std::isfinite(sum)) {
            irradiances.push_back(sum);
        }
    }
    if (irradiances.empty()) {
        return 0;
    }
    const auto half =
        irradiances.begin() + static_cast<std::ptrdiff_t>((irradiances.size() + 1) / 2);
    std::nth_element(irradiances.begin(), half - 1, irradiances.end(), std::greater<>());
    double logs = 0;
    std::for_each(irradiances.begin(), half, [&](double one) { logs += std::log(one); });
    return std::exp(logs / static_cast<double>(half - irradiances.begin()));
}

} // namespace froxel::light
