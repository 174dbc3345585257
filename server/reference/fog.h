// A medium that absorbs light and scatters it once, in double, along one ray. Written apart from
// the shaders: lights are integrated along the ray, not sampled in a volume.
//
// Stated model: extinction is `density` up to the base height and falls off exponentially above it;
// light from all around is the mean of sky and ground, or of the environment; it and suns arrive
// undimmed; what a lamp sends is dimmed on its way to where it scatters, as what scatters is on its
// way to the eye. Surfaces are lit as without the medium.
#pragma once

#include "reference/brdf.h"
#include "reference/lights.h"
#include "reference/rays.h"
#include "settings/settings.h"

namespace froxel::reference {

// Henyey-Greenstein: share of light a steradian; `cosine` 1: it goes straight on.
[[nodiscard]] double phase(double anisotropy, double cosine);

class Medium {
  public:
    // All live as long as this. `open` is asked for shadowed lights.
    Medium(const settings::Fog& fog,
           const settings::Camera& camera,
           const Lights& lights,
           const Open& open);

    // In the world's axes, relative to the eye, metres.
    [[nodiscard]] double densityAt(const glm::dvec3& point) const;
    [[nodiscard]] double opticalDepth(const glm::dvec3& from, const glm::dvec3& to) const;

    // What a point light sends to the ray's origin by way of the first `length_m` metres of it. By
    // angles seen from the light (Kulla and Fajardo 2012), in kPoints places of Gauss and Legendre.
    [[nodiscard]] glm::dvec3
    scattered(const PointLight& light, const Ray& ray, double length_m) const;
    // What scatters towards the eye at a point, of a rectangle's intensity and of the point's
    // density.
    [[nodiscard]] double
    fromRectangle(const PointLight& light, const glm::dvec3& point, const glm::dvec3& away) const;
    static constexpr int kPoints = 48;

    // Radiance at `distance` along the view axis as it is seen; infinity: at nothing.
    [[nodiscard]] glm::dvec3
    seenThrough(const glm::dvec3& radiance, const Ray& ray, double distance) const;

  private:
    const settings::Fog& fog_;
    const Lights& lights_;
    const Open& open_;
    double density_;
    double falloff_;
    double eye_height_m_; // above the base height
};

} // namespace froxel::reference
