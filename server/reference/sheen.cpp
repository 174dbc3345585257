#include "reference/sheen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace froxel::reference {
namespace {

double alphaOf(double roughness) {
    return std::pow(std::max(roughness, kLeastSheenRoughness), 2);
}

// Equation 4 of the paper, with the numbers of its table 1.
double curve(double cosine, double alpha) {
    const double rough = 1 - std::pow(1 - alpha, 2);
    const double a = std::lerp(25.3245, 21.5473, rough);
    const double b = std::lerp(3.32435, 3.82987, rough);
    const double c = std::lerp(0.16801, 0.19823, rough);
    const double d = std::lerp(-1.27393, -1.97760, rough);
    const double e = std::lerp(-4.85967, -4.32054, rough);
    return a / (1 + b * std::pow(cosine, c)) + d * cosine + e;
}

double lambda(double cosine, double alpha) {
    return std::exp(cosine < 0.5 ? curve(cosine, alpha)
                                 : 2 * curve(0.5, alpha) - curve(1 - cosine, alpha));
}

// Over half vectors, more of them where they lie flat.
double integral(double n_dot_v, double roughness) {
    constexpr int kPolar = 96;
    constexpr int kAround = 48; // half a turn: the lobe is symmetric
    const double sine_v = std::sqrt(1 - n_dot_v * n_dot_v);
    double sum = 0;
    for (int i = 0; i < kPolar; ++i) {
        const double root = (i + 0.5) / kPolar;
        const double n_dot_h = root * root;
        for (int k = 0; k < kAround; ++k) {
            const double around = std::numbers::pi * (k + 0.5) / kAround;
            const double v_dot_h =
                sine_v * std::sqrt(1 - n_dot_h * n_dot_h) * std::cos(around) + n_dot_v * n_dot_h;
            const double n_dot_l = 2 * v_dot_h * n_dot_h - n_dot_v;
            if (v_dot_h > 0 && n_dot_l > 0) {
                const double part =
                    4 * v_dot_h * 2 * root / kPolar * 2 * std::numbers::pi / kAround;
                sum += sheenLobe(n_dot_h, n_dot_l, n_dot_v, roughness) * n_dot_l * part;
            }
        }
    }
    return sum;
}

// By n.v's cube root and the root of roughness above the least; off by up to 0.0025, where the
// integral is above 1 by 0.006.
constexpr size_t kTable = 32;
constexpr double kLast = kTable - 1;
using Table = std::array<std::array<double, kTable>, kTable>;

const Table& table() {
    static const Table filled = [] {
        Table out;
        for (size_t row = 0; row < kTable; ++row) {
            const double y = static_cast<double>(row) / kLast;
            for (size_t column = 0; column < kTable; ++column) {
                out[row][column] =
                    integral(std::max(1e-4, std::pow(static_cast<double>(column) / kLast, 3)),
                             kLeastSheenRoughness + (1 - kLeastSheenRoughness) * y * y);
            }
        }
        return out;
    }();
    return filled;
}

} // namespace

double sheenLobe(double n_dot_h, double n_dot_l, double n_dot_v, double roughness) {
    const double alpha = alphaOf(roughness);
    const double sine = std::sqrt(std::max(0.0, 1 - n_dot_h * n_dot_h));
    const double distribution =
        (2 + 1 / alpha) * std::pow(sine, 1 / alpha) / (2 * std::numbers::pi);
    return distribution /
           ((1 + lambda(n_dot_l, alpha) + lambda(n_dot_v, alpha)) * 4 * n_dot_l * n_dot_v);
}

double sheenAlbedo(double n_dot_v, double roughness) {
    const double above = std::max(roughness - kLeastSheenRoughness, 0.0);
    const double x = std::cbrt(n_dot_v) * kLast;
    const double y = std::sqrt(above / (1 - kLeastSheenRoughness)) * kLast;
    const size_t column = std::min(static_cast<size_t>(x), kTable - 2);
    const size_t row = std::min(static_cast<size_t>(y), kTable - 2);
    const auto across = [&](size_t r) {
        return std::lerp(table()[r][column], table()[r][column + 1],
                         x - static_cast<double>(column));
    };
    return std::lerp(across(row), across(row + 1), y - static_cast<double>(row));
}

double belowSheen(const Sheen& sheen, double n_dot_v) {
    const glm::dvec3 reflected = sheenReflectance(sheen, n_dot_v);
    return 1 - std::max({reflected.x, reflected.y, reflected.z});
}

glm::dvec3 sheenStrength(const Sheen& sheen, double n_dot_v) {
    return sheen.color / std::max(1.0, sheenAlbedo(n_dot_v, sheen.roughness));
}

glm::dvec3 sheenReflectance(const Sheen& sheen, double n_dot_v) {
    return sheen.color * std::min(1.0, sheenAlbedo(n_dot_v, sheen.roughness));
}

} // namespace froxel::reference
