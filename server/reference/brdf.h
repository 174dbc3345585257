// What a surface sends towards the eye: glTF 2.0, appendix B, or one of the other shading models,
// in double.
#pragma once

#include "reference/anisotropy.h"
#include "reference/film.h"
#include "reference/lights.h"
#include "reference/sheen.h"
#include "settings/settings.h"

#include <functional>

namespace froxel::reference {

inline constexpr double kLeastRoughness = 0.045; // a smaller highlight would slip between pixels
// A light's irradiance is colour * window / max(d, nearest)^2, window = max(0, 1 - (d^2/r^2)^2)^2:
// exactly 0 from its radius on.

// A clear coat over a surface.
struct Coat {
    double strength = 0;
    double roughness = 0;
    glm::dvec3 normal{0, 1, 0}; // unit
};

// Light from behind that a surface scatters towards the eye, in place of as much of its base
// colour.
struct DiffuseTransmission {
    double strength = 0;
    glm::dvec3 color{1}; // dimmed by the body behind
};

// Light that passes the surface as through glass.
struct Transmission {
    double strength = 0;
    double roughness = 0; // of what is seen through it
    double ior = 1.5;
    double dispersion = 0;     // 20 over Abbe's number
    double thickness = 0;      // in object space
    glm::dvec3 attenuation{1}; // what a metre in the body leaves of white light
    glm::dvec3 left{1};        // what all the way through it leaves, which its user finds out
};

// Everything is in the world's axes; `position` is relative to the eye.
struct Surface {
    glm::dvec3 position{0};
    glm::dvec3 normal{0, 1, 0}; // unit
    glm::dvec3 to_eye{0, 1, 0}; // unit
    glm::dvec3 base_color{1};
    double metallic = 0;
    glm::dvec3 dielectric_f0{0.04}; // what its dielectric part reflects, head-on
    double dielectric_f90 = 1;      // and at grazing angles
    double roughness = 1;
    double occlusion = 1;
    glm::dvec3 emissive{0};
    Coat coat;
    Sheen sheen;
    Anisotropy anisotropy;
    Film film;
    DiffuseTransmission diffuse_transmission;
    Transmission transmission;
    double alpha = 1;
    bool unlit = false;
};

// The share of light that passes from one point to another, relative to the eye.
using Open = std::function<double(const glm::dvec3& from, const glm::dvec3& to)>;

struct Model {
    settings::ShadingModel shading = settings::ShadingModel::kPbr;
    const settings::ToonRamp* ramp = nullptr; // over n.l of what is scattered; null: n.l itself
    uint32_t bands = 0;                       // of each light; with a ramp
    double rim = 0; // how much more is scattered where n.v is below the rim's width
    double rim_width = 0;
};

// Of the normal, on either side; at least 1e-4, as the shaders have it.
[[nodiscard]] double cosineToEye(const Surface& surface);

// Whether highlights are not round: Blinn's always are.
[[nodiscard]] bool isStretched(const Surface& surface, const Model& model);

// What its colours make of matt light on its own side and on the other.
[[nodiscard]] glm::dvec3 scattered(const Surface& surface,
                                   const Model& model,
                                   const glm::dvec3& ahead,
                                   const glm::dvec3& behind);

// The share of what the eye sees of a surface that is its coat's own; 0 where the model knows none.
[[nodiscard]] double coatShare(const Surface& surface, const Model& model);

// Radiance towards the eye for light of unit irradiance from direction `to_light` (unit), per
// channel: BRDF times cosine, under its coat and with it; without bands.
[[nodiscard]] glm::dvec3
reflected(const Surface& surface, const Model& model, const glm::dvec3& to_light);

// The share of a light's intensity, candela, that is irradiance at a point `to_light` away from it,
// on a plane that faces it; 0 from its radius on.
[[nodiscard]] double attenuation(const PointLight& light, const glm::dvec3& to_light);

// All lights, light from around or the ambient light, and emission; of an unlit surface its base
// colour. open: of shadowed lights. seen: what arrives from behind a surface that transmits light.
[[nodiscard]] glm::dvec3 radiance(const Surface& surface,
                                  const Model& model,
                                  const Lights& lights,
                                  const Open& open = {},
                                  const glm::dvec3& seen = glm::dvec3(0));

} // namespace froxel::reference
