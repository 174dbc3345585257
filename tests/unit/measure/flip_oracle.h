// LDR-FLIP once more, in double, from the paper's formulas as they stand: two-dimensional kernels,
// no separation, matrices inverted numerically. Slow; for small pictures.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

namespace froxel::measure::oracle {

struct Colours {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> pixels;

    [[nodiscard]] const glm::dvec3& clamped(int x, int y) const {
        return pixels[static_cast<size_t>(std::clamp(y, 0, height - 1) * width +
                                          std::clamp(x, 0, width - 1))];
    }
};

// Rows of the usual sRGB matrix as exact fractions, transposed by GLM's column order.
inline glm::dmat3 xyzFromLinear() {
    return glm::transpose(
        glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794, //
                   2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,   //
                   1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
}

inline glm::dvec3 opponent(const glm::dvec3& f) {
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

inline glm::dvec3 white() {
    return xyzFromLinear() * glm::dvec3(1);
}

inline glm::dvec3 linearFromYcxcz(const glm::dvec3& c) {
    const double y = (c.x + 16) / 116;
    return glm::inverse(xyzFromLinear()) * (white() * glm::dvec3(y + c.y / 500, y, y - c.z / 200));
}

inline glm::dvec3 huntLab(const glm::dvec3& linear) {
    glm::dvec3 f = xyzFromLinear() * linear / white();
    for (int c = 0; c < 3; ++c) {
        const double delta = 6.0 / 29;
        f[c] =
            f[c] > delta * delta * delta ? std::cbrt(f[c]) : f[c] / (3 * delta * delta) + 4.0 / 29;
    }
    const glm::dvec3 lab = opponent(f);
    return {lab.x, lab.x / 100 * lab.y, lab.x / 100 * lab.z};
}

inline double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

inline double colourError(double distance) {
    const double largest = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), 0.7);
    const double power = std::pow(distance, 0.7);
    return power < 0.4 * largest ? power / (0.4 * largest) * 0.95
                                 : 0.95 + (power - 0.4 * largest) / (0.6 * largest) * 0.05;
}

// Sum over the window of kernel(dx, dy) * pixel, componentwise.
inline glm::dvec3 windowSum(const Colours& image,
                            int x,
                            int y,
                            int radius,
                            const std::function<glm::dvec3(int, int)>& kernel) {
    glm::dvec3 sum(0);
    for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
            sum += kernel(dx, dy) * image.clamped(x + dx, y + dy);
        }
    }
    return sum;
}

inline glm::dvec3 sensitivity(double dx, double dy, double ppd) {
    const double d2 = (dx * dx + dy * dy) / (ppd * ppd);
    const auto term = [&](double a, double b) {
        const double pi = std::numbers::pi;
        return a * std::sqrt(pi / b) * std::exp(-pi * pi * d2 / b);
    };
    return {term(1, 0.0047), term(1, 0.0053), term(34.1, 0.04) + term(13.5, 0.025)};
}

inline glm::dvec3 seenLab(const Colours& ycxcz, int x, int y, double ppd) {
    const int radius = static_cast<int>(
        std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * ppd));
    const Colours ones{1, 1, {glm::dvec3(1)}};
    const auto kernel = [&](int dx, int dy) { return sensitivity(dx, dy, ppd); };
    const auto filtered =
        windowSum(ycxcz, x, y, radius, kernel) / windowSum(ones, 0, 0, radius, kernel);
    return huntLab(glm::clamp(linearFromYcxcz(filtered), 0.0, 1.0));
}

// Length of the response to derivatives in x and in y; order 1: edges, 2: points.
inline double feature(const Colours& ycxcz, int x, int y, double ppd, int order) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto raw = [&](double dx, double dy) {
        const double g = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
        return order == 1 ? -dx * g : (dx * dx / (sigma * sigma) - 1) * g;
    };
    double positive = 0;
    double negative = 0;
    for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
            (raw(dx, dy) > 0 ? positive : negative) += raw(dx, dy);
        }
    }
    const auto weight = [&](double dx, double dy) {
        const double w = raw(dx, dy);
        return w > 0 ? w / positive : w / -negative;
    };
    Colours luminance = ycxcz;
    for (auto& pixel : luminance.pixels) {
        pixel = glm::dvec3((pixel.x + 16) / 116);
    }
    const auto both = windowSum(luminance, x, y, radius, [&](int dx, int dy) {
        return glm::dvec3(weight(dx, dy), weight(dy, dx), 0);
    });
    return std::hypot(both.x, both.y);
}

// Mean over the picture of error(x, y); the pictures come as linear RGB in 0..1 and reach it as
// YCxCz.
inline double
meanError(Colours a,
          Colours b,
          const std::function<double(const Colours&, const Colours&, int, int)>& error) {
    for (auto* image : {&a, &b}) {
        for (auto& pixel : image->pixels) {
            pixel = opponent(xyzFromLinear() * pixel / white());
        }
    }
    double sum = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            sum += error(a, b, x, y);
        }
    }
    return sum / (a.width * a.height);
}

inline double meanColourError(const Colours& a, const Colours& b, double ppd) {
    return meanError(a, b, [&](const Colours& ya, const Colours& yb, int x, int y) {
        return colourError(hyab(seenLab(ya, x, y, ppd), seenLab(yb, x, y, ppd)));
    });
}

inline double meanFlip(const Colours& a, const Colours& b, double ppd) {
    return meanError(a, b, [&](const Colours& ya, const Colours& yb, int x, int y) {
        double difference = 0;
        for (const int order : {1, 2}) {
            difference = std::max(difference, std::abs(feature(ya, x, y, ppd, order) -
                                                       feature(yb, x, y, ppd, order)));
        }
        const double colour = colourError(hyab(seenLab(ya, x, y, ppd), seenLab(yb, x, y, ppd)));
        return std::pow(colour, 1 - std::sqrt(difference / std::numbers::sqrt2));
    });
}

} // namespace froxel::measure::oracle
