// Fibres over a surface: KHR_materials_sheen, in double, by Estevez and Kulla 2017, "Production
// Friendly Microfacet Sheen BRDF".
#pragma once

#include <glm/vec3.hpp>

namespace froxel::reference {

inline constexpr double kLeastSheenRoughness = 0.07;

struct Sheen {
    glm::dvec3 color{0}; // 0: none
    double roughness = 0;
};

// Distribution times shadowing over 4 |n.l| |n.v|, of white fibres. Cosines above 0.
[[nodiscard]] double sheenLobe(double n_dot_h, double n_dot_l, double n_dot_v, double roughness);

// That times n.l over the hemisphere, by integration. Above 1 at grazing angles of low roughness.
[[nodiscard]] double sheenAlbedo(double n_dot_v, double roughness);

// The share of what is below the fibres that the eye still sees.
[[nodiscard]] double belowSheen(const Sheen& sheen, double n_dot_v);

// What the lobe is multiplied by, at each channel: never more is reflected than comes.
[[nodiscard]] glm::dvec3 sheenStrength(const Sheen& sheen, double n_dot_v);

// What fibres reflect of even light.
[[nodiscard]] glm::dvec3 sheenReflectance(const Sheen& sheen, double n_dot_v);

} // namespace froxel::reference
