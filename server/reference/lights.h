// The lights of a frame in double, from their definitions.
#pragma once

#include "environment/surroundings.h"
#include "light/falloff.h"
#include "scene/scene.h"
#include "settings/settings.h"

#include <limits>
#include <optional>
#include <vector>

namespace froxel::reference {

// The world's axes, relative to the eye.
struct PointLight {
    glm::dvec3 position{0};
    double radius2 = std::numeric_limits<double>::infinity(); // m^2; infinity: no range limit
    glm::dvec3 color{0};                                      // linear, times intensity
    // A spot's angular falloff, clamp(cos * scale + offset, 0, 1)^2; a point light's is 1.
    glm::dvec3 direction{0}; // the way the light travels
    double cone_scale = 0;
    double cone_offset = 1;
    double nearest_m = light::kNearest_m; // a smaller distance counts as this
    double bands_middle = 0;              // of its toon bands, irradiance per candela
    // A rectangle's halves, perpendicular to the direction, which it shines to as a whole.
    struct Rectangle {
        glm::dvec3 half_right{0};
        glm::dvec3 half_up{0};
    };
    std::optional<Rectangle> rectangle = std::nullopt;
    bool shadowed = false; // what stands between it and a surface takes its light away

    // Calls visit(position, share of the whole) at the middles of the rectangle's parts, which are
    // the smaller the nearer they are to the point.
    template <class Visit>
    void eachPart(const glm::dvec3& seen_from, const Visit& visit) const {
        for (int i = 0; i < kParts; ++i) {
            for (int k = 0; k < kParts; ++k) {
                splitPart(seen_from, {(2 * i + 1.0) / kParts - 1, (2 * k + 1.0) / kParts - 1},
                          1.0 / kParts, visit);
            }
        }
    }

  private:
    static constexpr int kParts = 16;
    static constexpr double kMostSeen = 0.1; // a part's half diagonal over its distance
    static constexpr double kLeastPart = 1.0 / (kParts << 6);

    template <class Visit>
    void splitPart(const glm::dvec3& seen_from,
                   const glm::dvec2& middle,
                   double half,
                   const Visit& visit) const {
        const glm::dvec3 at =
            position + rectangle->half_right * middle.x + rectangle->half_up * middle.y;
        const double extent = half * glm::length(rectangle->half_right + rectangle->half_up);
        if (extent <= kMostSeen * glm::distance(seen_from, at) || half <= kLeastPart) {
            visit(at, half * half);
            return;
        }
        for (const double x : {-0.5, 0.5}) {
            for (const double y : {-0.5, 0.5}) {
                splitPart(seen_from, middle + glm::dvec2(x, y) * half, half / 2, visit);
            }
        }
    }
};

struct DirectionalLight {
    glm::dvec3 direction{0}; // unit, the way the light travels
    glm::dvec3 color{0};
};

// Light from around; see around.h.
struct Around {
    const environment::Surroundings* seen = nullptr;
    double rotation_rad = 0;
    double strength = 1;
    environment::Diffuse matt; // turned, and with the strength
};

struct Lights {
    std::vector<PointLight> points; // seeded ones, then the scene's points and spots
    std::vector<DirectionalLight> directionals;
    // Ambient radiance; of light from around, which takes its place on surfaces, the mean.
    glm::dvec3 sky{0};
    glm::dvec3 ground{0};
    std::optional<Around> around;
};

// Shadowed: those that have maps by light/shadow_choice.h.
[[nodiscard]] Lights
lightsAt(const scene::Scene& scene, const settings::ViewSettings& settings, double time_s);

} // namespace froxel::reference
