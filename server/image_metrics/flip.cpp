#include "image_metrics/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::image_metrics::flip {

namespace {

// Section 4.1: contrast sensitivity as a sum of Gaussians a sqrt(pi / b) exp(-pi^2 d^2 / b), d in
// degrees.
struct Sensitivity {
    double a;
    double b;
};
constexpr Sensitivity kAchromatic = {1, 0.0047};
constexpr Sensitivity kRedGreen = {1, 0.0053};
constexpr std::array<Sensitivity, 2> kBlueYellow = {Sensitivity{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidestB = 0.04;

// Sections 4.1.3 and 4.2, 4.3.
constexpr float kColourExponent = 0.7F;
constexpr float kKneeIn = 0.4F;   // of the largest distance
constexpr float kKneeOut = 0.95F; // the error there
constexpr double kFeatureWidthDegrees = 0.082;
constexpr float kFeatureExponent = 0.5F;

constexpr Rgb kWhiteXyz = {0.950428545F, 1, 1.088900371F}; // D65, of the matrix below

Rgb xyzOf(const Rgb& linear) {
    const auto [r, g, b] = linear;
    return {0.4123865F * r + 0.3575915F * g + 0.1804505F * b,
            0.2126368F * r + 0.7151830F * g + 0.0721802F * b,
            0.0193306F * r + 0.1191972F * g + 0.9503726F * b};
}

Rgb linearOf(const Rgb& xyz) {
    const auto [x, y, z] = xyz;
    return {3.241003275F * x - 1.537398934F * y - 0.498615861F * z,
            -0.969224334F * x + 1.875930071F * y + 0.041554224F * z,
            0.055639423F * x - 0.204011202F * y + 1.057148933F * z};
}

// L*a*b*'s axes over any function of X, Y, Z relative to white; the identity gives YCxCz.
Rgb opponentOf(const Rgb& relative) {
    return {116 * relative[1] - 16, 500 * (relative[0] - relative[1]),
            200 * (relative[1] - relative[2])};
}

Rgb ycxczOf(const Rgb& linear) {
    const Rgb xyz = xyzOf(linear);
    return opponentOf({xyz[0] / kWhiteXyz[0], xyz[1] / kWhiteXyz[1], xyz[2] / kWhiteXyz[2]});
}

Rgb linearFromYcxcz(const Rgb& ycxcz) {
    const float y = (ycxcz[0] + 16) / 116;
    return linearOf({(y + ycxcz[1] / 500) * kWhiteXyz[0], y * kWhiteXyz[1],
                     (y - ycxcz[2] / 200) * kWhiteXyz[2]});
}

float labCurve(float t) {
    constexpr float kDelta = 6.0F / 29;
    return t > kDelta * kDelta * kDelta ? std::pow(t, 1.0F / 3)
                                        : t / (3 * kDelta * kDelta) + 4.0F / 29;
}

float largestColourPower() {
    static const float power =
        std::pow(hyab(huntAdjustedLab({0, 1, 0}), huntAdjustedLab({0, 0, 1})), kColourExponent);
    return power;
}

Plane<float> separably(const Plane<float>& plane,
                       const std::vector<double>& horizontal,
                       const std::vector<double>& vertical) {
    return filterColumns(filterRows(plane, horizontal), vertical);
}

size_t sensitivityRadius(double pixels_per_degree) {
    return static_cast<size_t>(
        std::ceil(3 * std::sqrt(kWidestB / 2) / std::numbers::pi * pixels_per_degree));
}

double featureSigma(double pixels_per_degree) {
    return 0.5 * kFeatureWidthDegrees * pixels_per_degree;
}

size_t featureRadius(double pixels_per_degree) {
    return static_cast<size_t>(std::ceil(3 * featureSigma(pixels_per_degree)));
}

struct SensitivityFilter {
    size_t radius_px;
    double pixels_per_degree;

    [[nodiscard]] std::vector<double> kernel(const Sensitivity& term) const {
        return gaussianKernel(radius_px,
                              std::sqrt(term.b / 2) / std::numbers::pi * pixels_per_degree);
    }
    // Share of a term in the whole: its weights summed over the filter's pixels.
    [[nodiscard]] double weight(const Sensitivity& term) const {
        double side = 0;
        for (size_t i = 0; i <= 2 * radius_px; ++i) {
            const double d =
                (static_cast<double>(i) - static_cast<double>(radius_px)) / pixels_per_degree;
            side += std::exp(-std::numbers::pi * std::numbers::pi * d * d / term.b);
        }
        return term.a * std::sqrt(std::numbers::pi / term.b) * side * side;
    }
    [[nodiscard]] Plane<float> apply(const Plane<float>& plane, const Sensitivity& term) const {
        return separably(plane, kernel(term), kernel(term));
    }
};

// What the observer's eye makes of YCxCz: filtered, back in the RGB cube, as Hunt-adjusted L*a*b*.
RgbPlanes seenColours(const RgbPlanes& ycxcz, double pixels_per_degree) {
    const SensitivityFilter filter{sensitivityRadius(pixels_per_degree), pixels_per_degree};
    RgbPlanes seen = {filter.apply(ycxcz[0], kAchromatic), filter.apply(ycxcz[1], kRedGreen),
                      filter.apply(ycxcz[2], kBlueYellow[0])};
    const auto narrow = filter.apply(ycxcz[2], kBlueYellow[1]);
    const double wide_weight = filter.weight(kBlueYellow[0]);
    const auto share =
        static_cast<float>(wide_weight / (wide_weight + filter.weight(kBlueYellow[1])));
    for (size_t i = 0; i < narrow.values.size(); ++i) {
        const float cz = share * seen[2].values[i] + (1 - share) * narrow.values[i];
        Rgb linear = linearFromYcxcz({seen[0].values[i], seen[1].values[i], cz});
        for (float& channel : linear) {
            channel = std::clamp(channel, 0.0F, 1.0F);
        }
        const Rgb lab = huntAdjustedLab(linear);
        for (size_t c = 0; c < 3; ++c) {
            seen[c].values[i] = lab[c];
        }
    }
    return seen;
}

struct Features {
    Plane<float> edges;  // length of the first derivative's vector
    Plane<float> points; // of the second's
};

// Positive weights to a sum of 1, negative ones to -1.
std::vector<double> balanced(std::vector<double> kernel) {
    double positive = 0;
    double negative = 0;
    for (const double weight : kernel) {
        (weight > 0 ? positive : negative) += weight;
    }
    for (double& weight : kernel) {
        weight /= weight > 0 ? positive : -negative;
    }
    return kernel;
}

Plane<float> length(Plane<float> x, const Plane<float>& y) {
    for (size_t i = 0; i < x.values.size(); ++i) {
        x.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
    }
    return x;
}

// Section 4.2. The derivatives' kernels are a product of one in x and one in y, and so is their
// balance.
Features featuresOf(const Plane<float>& ycxcz_y, double pixels_per_degree) {
    const double sigma = featureSigma(pixels_per_degree);
    const size_t radius = featureRadius(pixels_per_degree);
    const auto smooth = gaussianKernel(radius, sigma);
    auto first = smooth;
    auto second = smooth;
    for (size_t i = 0; i < smooth.size(); ++i) {
        const double x = static_cast<double>(i) - static_cast<double>(radius);
        first[i] *= -x;
        second[i] *= x * x / (sigma * sigma) - 1;
    }
    first = balanced(std::move(first));
    second = balanced(std::move(second));
    Plane<float> luminance = ycxcz_y;
    for (float& value : luminance.values) {
        value = (value + 16) / 116;
    }
    const auto smooth_rows = filterRows(luminance, smooth);
    return {length(separably(luminance, first, smooth), filterColumns(smooth_rows, first)),
            length(separably(luminance, second, smooth), filterColumns(smooth_rows, second))};
}

struct Seen {
    RgbPlanes colours;
    Features features;
};

Seen see(RgbPlanes planes, double pixels_per_degree) {
    for (size_t i = 0; i < planes[0].values.size(); ++i) {
        const Rgb ycxcz = ycxczOf({planes[0].values[i], planes[1].values[i], planes[2].values[i]});
        for (size_t c = 0; c < 3; ++c) {
            planes[c].values[i] = ycxcz[c];
        }
    }
    return {seenColours(planes, pixels_per_degree), featuresOf(planes[0], pixels_per_degree)};
}

} // namespace

float linearFromSrgb(float srgb) {
    return srgb > 0.04045F ? std::pow((srgb + 0.055F) / 1.055F, 2.4F) : srgb / 12.92F;
}

float srgbFromLinear(float linear) {
    return linear > 0.0031308F ? 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F : linear * 12.92F;
}

Rgb huntAdjustedLab(const Rgb& linear) {
    const Rgb xyz = xyzOf(linear);
    const Rgb lab = opponentOf({labCurve(xyz[0] / kWhiteXyz[0]), labCurve(xyz[1] / kWhiteXyz[1]),
                                labCurve(xyz[2] / kWhiteXyz[2])});
    return {lab[0], 0.01F * lab[0] * lab[1], 0.01F * lab[0] * lab[2]};
}

float hyab(const Rgb& lab_a, const Rgb& lab_b) {
    const float a = lab_a[1] - lab_b[1];
    const float b = lab_a[2] - lab_b[2];
    return std::abs(lab_a[0] - lab_b[0]) + std::sqrt(a * a + b * b);
}

float colourError(float hyab_distance) {
    const float power = std::pow(hyab_distance, kColourExponent);
    const float largest = largestColourPower();
    const float knee = kKneeIn * largest;
    return power < knee ? kKneeOut / knee * power
                        : kKneeOut + (power - knee) / (largest - knee) * (1 - kKneeOut);
}

size_t reach(double pixels_per_degree) {
    return std::max(sensitivityRadius(pixels_per_degree), featureRadius(pixels_per_degree));
}

Plane<float>
errors(const RgbPlanes& picture, const RgbPlanes& reference, double pixels_per_degree) {
    const Seen a = see(picture, pixels_per_degree);
    const Seen b = see(reference, pixels_per_degree);
    const auto at = [](const RgbPlanes& planes, size_t i) -> Rgb {
        return {planes[0].values[i], planes[1].values[i], planes[2].values[i]};
    };
    Plane<float> result = picture[0];
    for (size_t i = 0; i < result.values.size(); ++i) {
        const float edge = std::abs(a.features.edges.values[i] - b.features.edges.values[i]);
        const float point = std::abs(a.features.points.values[i] - b.features.points.values[i]);
        const float feature =
            std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, kFeatureExponent);
        const float colour = colourError(hyab(at(a.colours, i), at(b.colours, i)));
        result.values[i] = std::pow(colour, 1 - feature);
    }
    return result;
}

} // namespace froxel::image_metrics::flip
