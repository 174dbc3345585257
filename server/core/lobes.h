// Lobes of glossy reflection in double: over Fresnel's term, without a cosine.
#pragma once

#include <cmath>
#include <numbers>

namespace froxel::lobes {

// Trowbridge and Reitz's distribution of microfacets.
[[nodiscard]] inline double distribution(double n_dot_h, double alpha2) {
    const double t = n_dot_h * n_dot_h * (alpha2 - 1) + 1;
    return n_dot_h > 0 ? alpha2 * std::numbers::inv_pi / (t * t) : 0.0;
}

// Smith's masking and shadowing over 4 |n.l| |n.v|, height-correlated (Heitz 2014, equation 99).
[[nodiscard]] inline double visibility(double n_dot_l, double n_dot_v, double alpha2) {
    const double l = n_dot_v * std::sqrt(alpha2 + (1 - alpha2) * n_dot_l * n_dot_l);
    const double v = n_dot_l * std::sqrt(alpha2 + (1 - alpha2) * n_dot_v * n_dot_v);
    return 0.5 / (l + v);
}

// The exponent that matches Beckmann's distribution (Walter et al. 2007).
[[nodiscard]] inline double shininess(double alpha2) {
    return 2 / alpha2 - 2;
}

// Blinn's lobe (1977) over what it reflects head-on (Giesen 2009).
[[nodiscard]] inline double blinnPhong(double n_dot_h, double alpha2) {
    const double s = shininess(alpha2);
    const double returned =
        8 * std::numbers::pi * (s + std::pow(2.0, -s / 2)) / ((s + 2) * (s + 4));
    return n_dot_h > 0 ? std::pow(n_dot_h, s) / returned : 0.0;
}

// Schlick's 1 - cosine to the fifth power.
[[nodiscard]] inline double fifth(double x) {
    return x * x * x * x * x;
}

} // namespace froxel::lobes
