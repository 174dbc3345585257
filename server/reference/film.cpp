#include "reference/film.h"

#include "core/lobes.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace froxel::reference {
namespace {

constexpr double kPi = std::numbers::pi;

double schlick(double f0, double cosine) {
    return f0 + (1 - f0) * lobes::fifth(1 - cosine);
}

// At a border between two indices of refraction.
double headOn(double from, double to) {
    return std::pow((to - from) / (to + from), 2);
}

// A Gaussian over frequencies, transformed: at the optical path in metres.
struct Sensitivity {
    double height;
    double place;
    double width;
    [[nodiscard]] double at(double path_m, double shift) const {
        const double phase = 2 * kPi * path_m;
        return height * std::sqrt(2 * kPi * width) * std::cos(place * phase + shift) *
               std::exp(-width * phase * phase) / 1.0685e-7;
    }
};
constexpr std::array<Sensitivity, 3> kXyz = {{{5.4856e-13, 1.6810e6, 4.3278e9},
                                              {4.4201e-13, 1.7953e6, 9.3046e9},
                                              {5.2481e-13, 2.2084e6, 6.6121e9}}};
constexpr Sensitivity kSecondOfX{9.7470e-14, 2.2399e6, 4.5282e9};

// Of a path and a shift at each channel.
glm::dvec3 colorOf(double path_m, const glm::dvec3& shift) {
    const glm::dvec3 xyz(kXyz[0].at(path_m, shift.x) + kSecondOfX.at(path_m, shift.x),
                         kXyz[1].at(path_m, shift.y), kXyz[2].at(path_m, shift.z));
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

} // namespace

glm::dvec3 filmReflects(const Film& film, const glm::dvec3& base_f0, double n_dot_v) {
    const double rise = std::clamp(film.thickness_nm / 0.03, 0.0, 1.0);
    const double ior = std::lerp(1.0, film.ior, rise * rise * (3 - 2 * rise));
    const double cosine = std::sqrt(std::max(0.0, 1 - (1 - n_dot_v * n_dot_v) / (ior * ior)));
    const double path_m = 2 * ior * film.thickness_nm * 1e-9 * cosine;
    const double outer = schlick(headOn(1, ior), n_dot_v);
    glm::dvec3 inner(0);
    glm::dvec3 shift(0);
    for (int i = 0; i < 3; ++i) {
        const double root = std::sqrt(std::clamp(base_f0[i], 0.0, 0.9999));
        const double base_ior = (1 + root) / (1 - root);
        inner[i] = schlick(headOn(ior, base_ior), cosine);
        shift[i] = kPi + (base_ior < ior ? kPi : 0);
    }
    const glm::dvec3 both = glm::min(outer * inner, 0.9999);
    const glm::dvec3 often = inner * std::pow(1 - outer, 2) / (1.0 - both);
    glm::dvec3 sum = outer + often;
    for (int order = 1; order <= 2; ++order) {
        sum += (often - (1 - outer)) * glm::pow(both, glm::dvec3(0.5 * order)) * 2.0 *
               colorOf(order * path_m, static_cast<double>(order) * shift);
    }
    return glm::clamp(sum, 0.0, 1.0);
}

} // namespace froxel::reference
