#include "reference/brdf.h"

#include "reference/toon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::reference {
namespace {

constexpr double kInvPi = std::numbers::inv_pi;

double fifth(double x) {
    return x * x * x * x * x;
}

// Trowbridge and Reitz's distribution of microfacets.
double distribution(double n_dot_h, double alpha2) {
    const double t = n_dot_h * n_dot_h * (alpha2 - 1) + 1;
    return n_dot_h > 0 ? alpha2 * kInvPi / (t * t) : 0.0;
}

// Smith's masking and shadowing over 4 |n.l| |n.v|, height-correlated (Heitz 2014, equation 99).
double visibility(double n_dot_l, double n_dot_v, double alpha2) {
    const double l = n_dot_v * std::sqrt(alpha2 + (1 - alpha2) * n_dot_l * n_dot_l);
    const double v = n_dot_l * std::sqrt(alpha2 + (1 - alpha2) * n_dot_v * n_dot_v);
    return 0.5 / (l + v);
}

// Blinn's lobe (1977) over what it reflects head-on (Giesen 2009), times the cosine's share of the
// BRDF; the exponent as Walter et al. (2007) match it to Beckmann's distribution.
double blinnPhong(double n_dot_h, double alpha2) {
    const double s = 2 / alpha2 - 2;
    const double returned =
        8 * std::numbers::pi * (s + std::pow(2.0, -s / 2)) / ((s + 2) * (s + 4));
    return n_dot_h > 0 ? std::pow(n_dot_h, s) / returned : 0.0;
}

// The colours of glTF's mixed dielectric and metal.
struct Colors {
    glm::dvec3 diffuse;
    glm::dvec3 f0;
};

Colors colorsOf(const Surface& s) {
    return {s.base_color * (1 - s.metallic), glm::mix(glm::dvec3(0.04), s.base_color, s.metallic)};
}

glm::dvec3 ambient(const Surface& s, const Model& model, const Lights& lights) {
    const double up = 0.5 + 0.5 * s.normal.y;
    const glm::dvec3 incoming = glm::mix(lights.ground, lights.sky, up);
    if (model.shading == view::ShadingModel::kLambert) {
        return incoming * s.base_color * s.occlusion;
    }
    const Colors colors = colorsOf(s);
    return incoming * (colors.diffuse + colors.f0) * s.occlusion;
}

} // namespace

glm::dvec3 reflected(const Surface& s, const Model& model, const glm::dvec3& to_light) {
    const double facing = std::max(0.0, glm::dot(s.normal, to_light));
    const double scattered = model.ramp != nullptr ? toonRamp(*model.ramp, facing) : facing;
    if (model.shading == view::ShadingModel::kLambert) {
        return s.base_color * (scattered * kInvPi);
    }
    const Colors colors = colorsOf(s);
    const glm::dvec3 sum = to_light + s.to_eye;
    const double length = glm::length(sum);
    const glm::dvec3 half = length > 0 ? sum / length : glm::dvec3(0);
    const glm::dvec3 fresnel =
        colors.f0 +
        (1.0 - colors.f0) * fifth(std::max(0.0, 1 - std::abs(glm::dot(s.to_eye, half))));
    glm::dvec3 out = (1.0 - fresnel) * colors.diffuse * (scattered * kInvPi);
    if (facing > 0) {
        const double alpha = std::pow(std::max(s.roughness, kLeastRoughness), 2);
        const double alpha2 = alpha * alpha;
        const double n_dot_h = glm::dot(s.normal, half);
        const double lobe =
            model.shading == view::ShadingModel::kBlinnPhong
                ? blinnPhong(n_dot_h, alpha2)
                : distribution(n_dot_h, alpha2) *
                      visibility(facing, std::abs(glm::dot(s.normal, s.to_eye)), alpha2);
        out += fresnel * (facing * lobe);
    }
    return out;
}

double attenuation(const PointLight& light, const glm::dvec3& to_light) {
    const double d2 = glm::dot(to_light, to_light);
    if (!(d2 < light.radius2) || d2 == 0) {
        return 0; // a light on the surface has no direction
    }
    const double x = d2 / light.radius2;
    const double window = 1 - x * x;
    const double along = -glm::dot(light.direction, to_light) / std::sqrt(d2);
    const double share = std::clamp(along * light.cone_scale + light.cone_offset, 0.0, 1.0);
    return window * window / std::max(d2, kFloor2_m2) * share * share;
}

glm::dvec3 radiance(const Surface& s, const Model& model, const Lights& lights, const Open& open) {
    if (s.unlit) {
        return s.base_color;
    }
    glm::dvec3 sum(0);
    for (const PointLight& light : lights.points) {
        const glm::dvec3 to_light = light.position - s.position;
        const double d2 = glm::dot(to_light, to_light);
        if (d2 < light.radius2) { // most lights are too far away
            const double share = attenuation(light, to_light);
            if (share > 0 && (!light.shadowed || open(s.position, light.position))) {
                sum += light.color * reflected(s, model, to_light / std::sqrt(d2)) * share;
            }
        }
    }
    for (const DirectionalLight& light : lights.directionals) {
        sum += light.color * reflected(s, model, -light.direction);
    }
    return sum + ambient(s, model, lights) + s.emissive;
}

} // namespace froxel::reference
