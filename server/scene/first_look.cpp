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
    return !scene.materials.empty() &&
           std::all_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& material) { return material.unlit; });
}

double within(const settings::Range<double>& range, double value) {
    return std::clamp(value, range.min, range.max);
}

// Crytek's, which all of the field knows lit by a thousand lights.
bool isShowcase(const Scene& scene) {
    return scene.name == "Sponza";
}

// Of the studio beside other lights. In a room, which it would light through the walls, less.
constexpr float kFill = 0.3F;
constexpr float kFillOfRooms = 0.25F;

// What a white surface sends, of white, of the light of the file's own that arrives in the mean:
// with the studio's fill it is near white.
constexpr double kOfWhite = 0.7;

// Dark and white things stand out from it, coloured ones keep their colours.
constexpr settings::Background kStudioBackground{glm::vec3(0.05F), 0.6F};

// White, under the ceiling, as far from each other as it is high.
settings::PlacedLights lampsOf(const BoundsD3& room) {
    const glm::dvec3 size = room.size();
    // Higher up the ceiling would be white: at 0.8 it gets 16 times what the floor gets.
    constexpr double kUp = 0.62;
    const double above_floor_m = kUp * size.y;
    const auto count = [&](double side_m) {
        return static_cast<int>(std::clamp(std::round(side_m / size.y), 1.0, 3.0));
    };
    const glm::ivec2 counts(count(size.x), count(size.z));
    const glm::dvec2 apart_m = glm::dvec2(size.x, size.z) / glm::dvec2(counts);
    // Of what one sends to the floor below it, what all send there: a lamp's light on a floor falls
    // by the cube of the cosine of its slant.
    double together = 0;
    for (int x = 0; x < counts.x; ++x) {
        for (int z = 0; z < counts.y; ++z) {
            const glm::dvec2 aside_m = apart_m * glm::dvec2(x - counts.x / 2, z - counts.y / 2);
            together += std::pow(1 + glm::dot(aside_m, aside_m) / std::pow(above_floor_m, 2), -1.5);
        }
    }
    std::vector<settings::PlacedLight> lamps;
    for (int i = 0; i < counts.x * counts.y; ++i) {
        const glm::dvec2 share =
            (glm::dvec2(i % counts.x, i / counts.x) + 0.5) / glm::dvec2(counts);
        settings::PlacedLight lamp;
        lamp.id = static_cast<uint32_t>(i + 1);
        lamp.position_world = room.min + size * glm::dvec3(share.x, kUp, share.y);
        // A white floor in the middle sends 0.4 of white.
        lamp.intensity = static_cast<float>(
            within(settings::kLightIntensityRange,
                   0.4 * glm::pi<double>() * above_floor_m * above_floor_m / together));
        lamp.radius_m =
            static_cast<float>(within(settings::kLightRadiusRange, roundNumber(glm::length(size))));
        lamps.push_back(lamp);
    }
    return settings::PlacedLights(std::move(lamps));
}

} // namespace

void lookFor(const Scene& scene, double arriving_lux, settings::ViewSettings& settings) {
    const auto surround = surroundOf(scene);
    const BoundsD3& bounds = surround ? surround->rest_world : scene.bounds_world;
    const double half_m = 0.5 * glm::length(bounds.size());
    settings::Lights& lights = settings.lights;
    if (half_m > 0 && std::isfinite(half_m)) {
        const double usual_m = settings::Lights().radius_m;
        const double radius_m = within(settings::kLightRadiusRange, roundNumber(0.12 * half_m));
        lights.radius_m = static_cast<float>(radius_m);
        lights.intensity = static_cast<float>(
            within(settings::kLightIntensityRange, std::pow(radius_m / usual_m, 2)));
    }
    if (scene.lights.empty() && isShowcase(scene)) {
        return;
    }
    lights.count = 0;
    settings.environment.light =
        allUnlit(scene) ? settings::EnvironmentLight::kOff : settings::EnvironmentLight::kStudio;
    settings.background = kStudioBackground;
    if (!settings.environment.present()) {
        return;
    }
    if (arriving_lux > 0) {
        lights.scene_light_intensity = static_cast<float>(within(
            settings::kSceneLightIntensityRange, glm::pi<double>() * kOfWhite / arriving_lux));
        settings.environment.strength = kFill;
    } else if (scene.lights.empty() && isRoom(scene)) {
        settings.environment.strength = kFillOfRooms;
        lights.placed =
            lights.placed.lights().empty() ? lampsOf(scene.bounds_world) : lights.placed;
    }
}

bool suitsEvening(const Scene& scene) {
    return scene.lights.empty() && isShowcase(scene);
}

} // namespace froxel::scene
