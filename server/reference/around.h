// Light from around as the renderers approximate it (environment/glossy.h), in double: what is left
// of a picture's difference is arithmetic. environment_error in tests/bench prices the
// approximation itself.
#pragma once

#include "environment/surroundings.h"
#include "reference/brdf.h"

namespace froxel::reference {

// Null where the settings have none, and where they ask for a panorama that the scene lacks.
[[nodiscard]] const environment::Surroundings*
surroundingsFor(const scene::Scene& scene, const settings::Environment& settings);

// About the mean over a lobe of this roughness about a direction of any length.
[[nodiscard]] glm::dvec3
radianceFrom(const Around& around, const glm::dvec3& direction, double roughness);

// Radiance towards the eye.
[[nodiscard]] glm::dvec3
fromAround(const Surface& surface, const Model& model, const Around& around);

// What its lobe's dielectric part reflects in all, bare and under its film.
[[nodiscard]] glm::dvec3 dielectricAround(const Surface& surface);
[[nodiscard]] glm::dvec3 filmedAround(const Surface& surface);

// What its coat reflects of it, of a share of 1: once, as of lights.
[[nodiscard]] glm::dvec3 coatAround(const Surface& surface, const Around& around);

} // namespace froxel::reference
