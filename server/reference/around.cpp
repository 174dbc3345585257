#include "reference/around.h"

#include "environment/albedo.h"
#include "environment/glossy.h"
#include "environment/panorama.h"

#include <algorithm>
#include <cmath>

namespace froxel::reference {
namespace {

constexpr double kLeastCosine = 1e-4; // to the eye, as the shaders have it

// Of f0 alone, at each channel.
glm::dvec3 reflectedShare(const glm::dvec3& f0, double f90, const environment::Albedo& albedo) {
    const glm::dvec3 once = f0 * (albedo.all - albedo.grazing) + f90 * albedo.grazing;
    return once * (1.0 + f0 * (1 / albedo.all - 1));
}

// Of f0 under its film, whose term is one for all of the lobe.
glm::dvec3 filmedShare(const Surface& s, const glm::dvec3& f0, const environment::Albedo& albedo) {
    const glm::dvec3 f = filmReflects(s.film, f0, cosineToEye(s));
    return f * albedo.all * (1.0 + f * (1 / albedo.all - 1));
}

// Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 26.
double glossyOcclusion(double n_dot_v, double occlusion, double roughness) {
    const double seen = std::pow(n_dot_v + occlusion, std::exp2(-16 * roughness - 1));
    return std::clamp(seen - 1 + occlusion, 0.0, 1.0);
}

// What is seen by a lobe about a normal.
glm::dvec3
glossyAround(const Surface& s, const glm::dvec3& normal, double roughness, const Around& around) {
    const double cosine = glm::dot(normal, s.to_eye);
    const double n_dot_v = std::max(std::abs(cosine), kLeastCosine);
    const glm::dvec3 towards =
        environment::lobeDirection(normal, 2 * cosine * normal - s.to_eye, roughness);
    return radianceFrom(around, towards, roughness) *
           glossyOcclusion(n_dot_v, s.occlusion, roughness);
}

} // namespace

const environment::Surroundings* surroundingsFor(const scene::Scene& scene,
                                                 const settings::Environment& settings) {
    switch (settings.light) {
    case settings::EnvironmentLight::kOff:
        return nullptr;
    case settings::EnvironmentLight::kStudio:
        return &environment::studioSurroundings();
    case settings::EnvironmentLight::kFile:
        return scene.surroundings.get();
    }
    return nullptr;
}

glm::dvec3 radianceFrom(const Around& around, const glm::dvec3& direction, double roughness) {
    return around.seen->glossy.at(environment::turned(direction, -around.rotation_rad), roughness) *
           around.strength;
}

glm::dvec3 fromAround(const Surface& s, const Model& model, const Around& around) {
    const glm::dvec3 matt = around.matt.at(s.normal) * s.occlusion;
    const glm::dvec3 sent = scattered(s, model, matt, around.matt.at(-s.normal) * s.occlusion);
    if (model.shading == settings::ShadingModel::kLambert) {
        return sent;
    }
    const double roughness = std::max(s.roughness, kLeastRoughness);
    const double n_dot_v = cosineToEye(s);
    auto albedo = environment::albedoFromTable(n_dot_v, roughness);
    glm::dvec3 glossy = glossyAround(s, s.normal, roughness, around);
    if (isStretched(s, model)) {
        const AnisotropyAxes axes(s.anisotropy, s.normal, roughness * roughness);
        glossy = glossyAround(s, axes.bent(s.anisotropy, s.normal, s.to_eye), roughness, around);
        albedo = environment::albedoFromTable(n_dot_v, std::pow(axes.alpha_t * axes.alpha_b, 0.25));
    }
    const glm::dvec3 of_dielectric = reflectedShare(s.dielectric_f0, s.dielectric_f90, albedo);
    const glm::dvec3 of_metal = reflectedShare(s.base_color, 1, albedo);
    const auto seen = [&](const glm::dvec3& dielectric, const glm::dvec3& metal) {
        const double entering = 1 - std::max({dielectric.x, dielectric.y, dielectric.z});
        return glm::mix(dielectric, metal, s.metallic) * glossy +
               sent * ((1 - s.metallic) * entering);
    };
    const glm::dvec3 plain = seen(of_dielectric, of_metal);
    if (s.film.strength == 0) {
        return plain;
    }
    return glm::mix(
        plain, seen(filmedShare(s, s.dielectric_f0, albedo), filmedShare(s, s.base_color, albedo)),
        s.film.strength);
}

namespace {

environment::Albedo albedoOf(const Surface& s) {
    return environment::albedoFromTable(cosineToEye(s), std::max(s.roughness, kLeastRoughness));
}

} // namespace

glm::dvec3 dielectricAround(const Surface& s) {
    return reflectedShare(s.dielectric_f0, s.dielectric_f90, albedoOf(s));
}

glm::dvec3 filmedAround(const Surface& s) {
    return filmedShare(s, s.dielectric_f0, albedoOf(s));
}

glm::dvec3 coatAround(const Surface& s, const Around& around) {
    const double roughness = std::max(s.coat.roughness, kLeastRoughness);
    const double n_dot_v = std::max(std::abs(glm::dot(s.coat.normal, s.to_eye)), kLeastCosine);
    return glossyAround(s, s.coat.normal, roughness, around) *
           environment::albedoFromTable(n_dot_v, roughness).all;
}

} // namespace froxel::reference
