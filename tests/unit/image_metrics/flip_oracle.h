// FLIP once more, in double, from the paper's formulas as they stand: two-dimensional kernels,
// no separation, matrices inverted numerically. Slow; for small pictures.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

namespace froxel::image_metrics::oracle {

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

// Each pixel's error(x, y); the pictures come as linear RGB in 0..1 and reach it as YCxCz.
inline std::vector<double>
errorMap(Colours a,
         Colours b,
         const std::function<double(const Colours&, const Colours&, int, int)>& error) {
    for (auto* image : {&a, &b}) {
        for (auto& pixel : image->pixels) {
            pixel = opponent(xyzFromLinear() * pixel / white());
        }
    }
    std::vector<double> map;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            map.push_back(error(a, b, x, y));
        }
    }
    return map;
}

inline double meanOf(const std::vector<double>& map) {
    return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

inline double meanColourError(const Colours& a, const Colours& b, double ppd) {
    return meanOf(errorMap(a, b, [&](const Colours& ya, const Colours& yb, int x, int y) {
        return colourError(hyab(seenLab(ya, x, y, ppd), seenLab(yb, x, y, ppd)));
    }));
}

inline std::vector<double> flipMap(const Colours& a, const Colours& b, double ppd) {
    return errorMap(a, b, [&](const Colours& ya, const Colours& yb, int x, int y) {
        double difference = 0;
        for (const int order : {1, 2}) {
            difference = std::max(difference, std::abs(feature(ya, x, y, ppd, order) -
                                                       feature(yb, x, y, ppd, order)));
        }
        const double colour = colourError(hyab(seenLab(ya, x, y, ppd), seenLab(yb, x, y, ppd)));
        return std::pow(colour, 1 - std::sqrt(difference / std::numbers::sqrt2));
    });
}

// Narkowicz's fit as he wrote it, of 0.6 times the radiance.
inline double aces(double radiance) {
    const double x = 0.6 * radiance;
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// HDR-FLIP of linear radiance, not negative: the largest of each pixel over exposures a stop or
// less apart, between those that show the reference's brightest and its median luminance as 0.85.
inline double meanHdrFlip(const Colours& a, const Colours& b, double ppd) {
    double low = 0;
    double high = 100;
    while (high - low > 1e-12) {
        const double middle = (low + high) / 2;
        (aces(middle) < 0.85 ? low : high) = middle;
    }
    std::vector<double> luminances;
    for (const auto& pixel : b.pixels) {
        luminances.push_back(glm::dot(pixel, glm::dvec3(0.2126, 0.7152, 0.0722)));
    }
    std::sort(luminances.begin(), luminances.end());
    const size_t count = luminances.size();
    const double median = (luminances[(count - 1) / 2] + luminances[count / 2]) / 2;
    const double first = std::log2(high / luminances.back());
    const double last = std::log2(high / median);
    const int exposures = std::max(2, static_cast<int>(std::ceil(last - first)));
    std::vector<double> worst(count, 0.0);
    for (int i = 0; i < exposures; ++i) {
        const double factor = std::exp2(first + (last - first) * i / (exposures - 1));
        Colours shown_a = a;
        Colours shown_b = b;
        for (auto* image : {&shown_a, &shown_b}) {
            for (auto& pixel : image->pixels) {
                pixel = {aces(factor * pixel.x), aces(factor * pixel.y), aces(factor * pixel.z)};
            }
        }
        const auto map = flipMap(shown_a, shown_b, ppd);
        for (size_t p = 0; p < count; ++p) {
            worst[p] = std::max(worst[p], map[p]);
        }
    }
    return meanOf(worst);
}

} // namespace froxel::image_metrics::oracle
