#include "image_metrics/flip.h"
#include "image_metrics/picture_error.h"
#include "image_metrics/pixels.h"
#include "image_metrics/structural_similarity.h"
#include "interface/heat_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace froxel::image_metrics {

namespace {

flip::RgbPlanes planesLike(size_t width_px, size_t height_px) {
    const Plane<float> plane{width_px, height_px, std::vector<float>(width_px * height_px)};
    return {plane, plane, plane};
}

// Of rows from `begin` to `end`.
flip::RgbPlanes linearPlanes(const PixelView& view, uint32_t begin, uint32_t end) {
    static const auto kLinear = [] {
        std::array<float, 256> table{};
        for (size_t i = 0; i < table.size(); ++i) {
            table[i] = flip::linearFromSrgb(static_cast<float>(i) / 255);
        }
        return table;
    }();
    auto planes = planesLike(view.width_px, end - begin);
    for (uint32_t y = begin; y < end; ++y) {
        for (uint32_t x = 0; x < view.width_px; ++x) {
            const auto bytes = bytesAt(view, x, y);
            for (size_t c = 0; c < 3; ++c) {
                planes[c].row(y - begin)[x] = kLinear[bytes[c]];
            }
        }
    }
    return planes;
}

// ITU-R BT.601 luma of the coded values, 0..255.
Plane<double> lumaOf(const PixelView& view) {
    Plane<double> luma{view.width_px, view.height_px, {}};
    luma.values.reserve(size_t{view.width_px} * view.height_px);
    for (uint32_t y = 0; y < view.height_px; ++y) {
        for (uint32_t x = 0; x < view.width_px; ++x) {
            const auto [r, g, b] = bytesAt(view, x, y);
            luma.values.push_back(0.299 * r + 0.587 * g + 0.114 * b);
        }
    }
    return luma;
}

// Narkowicz's fit of the ACES curve, "ACES Filmic Tone Mapping Curve", 2016, his scale of 0.6
// included: (A x^2 + B x) / (C x^2 + D x + E), x linear radiance times exposure.
constexpr double kAcesA = 0.6 * 0.6 * 2.51;
constexpr double kAcesB = 0.6 * 0.03;
constexpr double kAcesC = 0.6 * 0.6 * 2.43;
constexpr double kAcesD = 0.6 * 0.59;
constexpr double kAcesE = 0.14;

double aces(double x) {
    const double y = (kAcesA * x * x + kAcesB * x) / (kAcesC * x * x + kAcesD * x + kAcesE);
    return std::min(y, 1.0);
}

// The x > 0 that aces() takes to t.
double acesInverse(double t) {
    const double p = (kAcesB - kAcesD * t) / (kAcesA - kAcesC * t);
    const double q = -kAcesE * t / (kAcesA - kAcesC * t);
    return -0.5 * p + std::sqrt(0.25 * p * p - q);
}

constexpr double kShownAtEnds = 0.85;
// A reference that is black by half still gets a range of exposures.
constexpr double kLeastMedian = std::numeric_limits<float>::epsilon();

// log2 of what radiance is multiplied by, a stop or less apart.
std::vector<double> exposuresFor(const LinearImage& reference) {
    std::vector<double> luminances;
    luminances.reserve(reference.rgb.size() / 3);
    for (size_t i = 0; i < reference.rgb.size() / 3; ++i) {
        const auto [r, g, b] = pixelAt(reference, i);
        if (isFinite({r, g, b})) {
            luminances.push_back(0.2126 * r + 0.7152 * g + 0.0722 * b);
        }
    }
    if (luminances.empty()) {
        return {0};
    }
    const size_t middle = luminances.size() / 2;
    const auto upper = luminances.begin() + static_cast<std::ptrdiff_t>(middle);
    std::nth_element(luminances.begin(), upper, luminances.end());
    const double brightest = *std::max_element(upper, luminances.end());
    const double lower =
        luminances.size() % 2 == 1 ? *upper : *std::max_element(luminances.begin(), upper);
    if (brightest <= 0) {
        return {0};
    }
    const double median = std::max(0.5 * (lower + *upper), kLeastMedian);
    const double first = std::log2(acesInverse(kShownAtEnds) / brightest);
    const double last = std::log2(acesInverse(kShownAtEnds) / median);
    const auto count = static_cast<size_t>(std::max(2.0, std::ceil(last - first)));
    std::vector<double> exposures(count);
    for (size_t i = 0; i < count; ++i) {
        exposures[i] =
            first + (last - first) * static_cast<double>(i) / static_cast<double>(count - 1);
    }
    return exposures;
}

flip::RgbPlanes toneMapped(const LinearImage& image, double exposure) {
    auto planes = planesLike(image.width_px, image.height_px);
    const double factor = std::exp2(exposure);
    for (size_t i = 0; i < image.rgb.size() / 3; ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const double radiance =
                std::clamp(image.rgb[3 * i + c], 0.0F, std::numeric_limits<float>::max());
            planes[c].values[i] = static_cast<float>(aces(factor * radiance));
        }
    }
    return planes;
}

bool allFinite(const LinearImage& image) {
    return std::all_of(image.rgb.begin(), image.rgb.end(),
                       [](float value) { return std::isfinite(value); });
}

} // namespace

double meanOf(const Plane<float>& plane) {
    return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) /
           static_cast<double>(plane.values.size());
}

double structuralSimilarity(const PixelView& picture, const PixelView& reference) {
    expectAlike(picture, reference);
    return meanStructuralSimilarity(lumaOf(picture), lumaOf(reference));
}

Plane<float> flipErrors(const PixelView& picture, const PixelView& reference) {
    expectAlike(picture, reference);
    // In bands, with the rows around that theirs depend on: planes of a whole picture would take a
    // hundred bytes a pixel.
    constexpr uint32_t kBandRows = 128;
    const auto around = static_cast<uint32_t>(flip::reach(kPixelsPerDegree));
    const uint32_t height = picture.height_px;
    Plane<float> errors{picture.width_px, height, {}};
    errors.values.reserve(size_t{picture.width_px} * height);
    for (uint32_t begin = 0; begin < height; begin += kBandRows) {
        const uint32_t end = std::min(begin + kBandRows, height);
        const uint32_t above = std::min(begin, around);
        const uint32_t below = std::min(height - end, around);
        const auto band =
            flip::errors(linearPlanes(picture, begin - above, end + below),
                         linearPlanes(reference, begin - above, end + below), kPixelsPerDegree);
        const auto first = band.row(above).begin();
        errors.values.insert(
            errors.values.end(), first,
            first + static_cast<std::ptrdiff_t>(size_t{end - begin} * picture.width_px));
    }
    return errors;
}

PerceivedStats perceivedDifference(const PixelView& picture, const PixelView& reference) {
    return {.above_1_255_count = differing(picture, reference, 1).count,
            .mssim = structuralSimilarity(picture, reference),
            .flip = meanOf(flipErrors(picture, reference))};
}

std::optional<Plane<float>> hdrFlipErrors(const LinearImage& picture,
                                          const LinearImage& reference) {
    expectAlike(picture, reference);
    if (!allFinite(picture) || !allFinite(reference)) {
        return std::nullopt;
    }
    auto worst = planesLike(picture.width_px, picture.height_px)[0];
    for (const double exposure : exposuresFor(reference)) {
        const auto errors = flip::errors(toneMapped(picture, exposure),
                                         toneMapped(reference, exposure), kPixelsPerDegree);
        std::transform(errors.values.begin(), errors.values.end(), worst.values.begin(),
                       worst.values.begin(), [](float a, float b) { return std::max(a, b); });
    }
    return worst;
}

double hdrFlip(const LinearImage& picture, const LinearImage& reference) {
    const auto errors = hdrFlipErrors(picture, reference);
    return errors ? meanOf(*errors) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::byte> shownAsReference(const LinearImage& picture, const LinearImage& reference) {
    const auto exposures = exposuresFor(reference);
    const auto planes = toneMapped(picture, 0.5 * (exposures.front() + exposures.back()));
    std::vector<std::byte> rgba8(planes[0].values.size() * 4, std::byte{255});
    for (size_t i = 0; i < planes[0].values.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            const float value = planes[c].values[i];
            rgba8[4 * i + c] = std::byte{static_cast<uint8_t>(
                std::isnan(value) ? 0 : std::lround(255 * flip::srgbFromLinear(value)))};
        }
    }
    return rgba8;
}

std::vector<std::byte> heatMap(const Plane<float>& errors) {
    std::vector<std::byte> rgba8;
    rgba8.reserve(errors.values.size() * 4);
    for (const float error : errors.values) {
        const uint32_t color = io::heatColor(static_cast<uint32_t>(
            std::lround(std::clamp(error, 0.0F, 1.0F) * static_cast<float>(io::kHeatTop))));
        for (uint32_t shift = 0; shift < 32; shift += 8) {
            rgba8.push_back(std::byte{static_cast<uint8_t>((color >> shift) & 255)});
        }
    }
    return rgba8;
}

} // namespace froxel::image_metrics
