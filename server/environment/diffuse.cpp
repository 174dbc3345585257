#include "environment/diffuse.h"

#include "environment/panorama.h"

#include <glm/common.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace froxel::environment {
namespace {

constexpr double kPi = std::numbers::pi;

double cube(double x) {
    return x * x * x;
}

// Integrals over a column's angle about +Y: of 1 and of cosine and sine of the angle and its
// double.
struct Column {
    double cosine, sine, cosine2, sine2;

    Column(uint32_t index, uint32_t count) {
        const double begin = 2 * kPi * (static_cast<double>(index) / count - 0.5);
        const double end = 2 * kPi * ((index + 1.0) / count - 0.5);
        cosine = std::sin(end) - std::sin(begin);
        sine = std::cos(begin) - std::cos(end);
        cosine2 = (std::sin(2 * end) - std::sin(2 * begin)) / 2;
        sine2 = (std::cos(2 * begin) - std::cos(2 * end)) / 2;
    }
};

// Integrals over a row's angle from +Y, with the sine that makes it a solid angle: s is the angle's
// sine and y its cosine.
struct Row {
    double one, y, yy, s, sy, ss;

    Row(uint32_t index, uint32_t count) {
        const double begin = kPi * index / count;
        const double end = kPi * (index + 1) / count;
        const double y0 = std::cos(begin);
        const double y1 = std::cos(end);
        const double s0 = std::sin(begin);
        const double s1 = std::sin(end);
        one = y0 - y1;
        y = (y0 * y0 - y1 * y1) / 2;
        yy = (cube(y0) - cube(y1)) / 3;
        s = (end - begin - (s1 * y1 - s0 * y0)) / 2;
        sy = (cube(s1) - cube(s0)) / 3;
        ss = one - yy;
    }
};

// What a row's texels sum to, weighted by their columns.
struct RowSums {
    glm::dvec3 one{0}, cosine{0}, sine{0}, cosine2{0}, sine2{0};
};

RowSums sumsOf(const LinearImage& panorama, const std::vector<Column>& columns, uint32_t row) {
    RowSums sums;
    for (uint32_t x = 0; x < panorama.width_px; ++x) {
        const glm::dvec3 radiance = texel(panorama, x, row);
        const Column& column = columns[x];
        sums.one += radiance;
        sums.cosine += radiance * column.cosine;
        sums.sine += radiance * column.sine;
        sums.cosine2 += radiance * column.cosine2;
        sums.sine2 += radiance * column.sine2;
    }
    sums.one *= 2 * kPi / panorama.width_px;
    return sums;
}

// The squared norm of each polynomial's harmonic, and what a cosine lobe over pi leaves of its
// band: 1, 2/3 and 1/4.
constexpr double kOverPi = std::numbers::inv_pi;
constexpr std::array<double, 9> kScale = {kOverPi / 4,      kOverPi / 2,       kOverPi / 2,
                                          kOverPi / 2,      kOverPi * 15 / 16, kOverPi * 15 / 16,
                                          kOverPi * 5 / 64, kOverPi * 15 / 16, kOverPi * 15 / 64};

std::array<double, 9> polynomials(const glm::dvec3& n) {
    return {1,
            n.z,
            n.y,
            n.x,
            n.x * n.z,
            n.y * n.z,
            3 * n.y * n.y - 1,
            n.x * n.y,
            n.z * n.z - n.x * n.x};
}

} // namespace

glm::dvec3 Diffuse::at(const glm::dvec3& normal) const {
    const auto values = polynomials(normal);
    glm::dvec3 sum(0);
    for (size_t i = 0; i < terms.size(); ++i) {
        sum += terms[i] * values[i];
    }
    return glm::max(sum, 0.0);
}

Diffuse diffuseOf(const LinearImage& panorama) {
    std::vector<Column> columns;
    columns.reserve(panorama.width_px);
    for (uint32_t x = 0; x < panorama.width_px; ++x) {
        columns.emplace_back(x, panorama.width_px);
    }
    Diffuse out;
    for (uint32_t y = 0; y < panorama.height_px; ++y) {
        const RowSums sums = sumsOf(panorama, columns, y);
        const Row row(y, panorama.height_px);
        // x = s cos, z = s sin: xz = s^2 sin2 / 2, z^2 - x^2 = -s^2 cos2.
        const std::array<glm::dvec3, 9> integrals = {sums.one * row.one,
                                                     sums.sine * row.s,
                                                     sums.one * row.y,
                                                     sums.cosine * row.s,
                                                     sums.sine2 * (row.ss / 2),
                                                     sums.sine * row.sy,
                                                     sums.one * (3 * row.yy - row.one),
                                                     sums.cosine * row.sy,
                                                     sums.cosine2 * -row.ss};
        for (size_t i = 0; i < out.terms.size(); ++i) {
            out.terms[i] += integrals[i] * kScale[i];
        }
    }
    return out;
}

Diffuse placed(const Diffuse& diffuse, double angle_rad, double strength) {
    Diffuse out = diffuse;
    // Terms in pairs, cosine and sine of a multiple of the angle from +Z towards +X.
    const auto turn = [&](size_t cosine, size_t sine, double scale, double angle) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const glm::dvec3 a = diffuse.terms[cosine];
        const glm::dvec3 b = diffuse.terms[sine] * scale;
        out.terms[cosine] = a * c - b * s;
        out.terms[sine] = (a * s + b * c) / scale;
    };
    turn(1, 3, 1, angle_rad);
    turn(5, 7, 1, angle_rad);
    turn(8, 4, 0.5, 2 * angle_rad); // z^2 - x^2 and 2 xz
    for (glm::dvec3& term : out.terms) {
        term *= strength;
    }
    return out;
}

} // namespace froxel::environment
