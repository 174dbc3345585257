#include "image_metrics/structural_similarity.h"

#include <algorithm>
#include <functional>

namespace froxel::image_metrics {

namespace {

constexpr size_t kRadius = 5;
constexpr size_t kWindow = 2 * kRadius + 1;
constexpr double kSigma = 1.5;
constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
constexpr double kC2 = (0.03 * 255) * (0.03 * 255);

Plane<double> blurred(const Plane<double>& plane) {
    const auto kernel = gaussianKernel(kRadius, kSigma);
    return filterColumns(filterRows(plane, kernel), kernel);
}

Plane<double> product(const Plane<double>& a, const Plane<double>& b) {
    Plane<double> result = a;
    std::transform(a.values.begin(), a.values.end(), b.values.begin(), result.values.begin(),
                   std::multiplies<>());
    return result;
}

Plane<double> extended(const Plane<double>& plane) {
    Plane<double> result;
    result.width_px = std::max(plane.width_px, kWindow);
    result.height_px = std::max(plane.height_px, kWindow);
    result.values.resize(result.width_px * result.height_px);
    for (size_t y = 0; y < result.height_px; ++y) {
        const auto from = plane.row(std::min(y, plane.height_px - 1));
        const auto rest = std::copy(from.begin(), from.end(), result.row(y).begin());
        std::fill(rest, result.row(y).end(), from.back());
    }
    return result;
}

} // namespace

double meanStructuralSimilarity(const Plane<double>& a, const Plane<double>& b) {
    if (a.width_px < kWindow || a.height_px < kWindow) {
        return meanStructuralSimilarity(extended(a), extended(b));
    }
    const auto mean_a = blurred(a);
    const auto mean_b = blurred(b);
    const auto square_a = blurred(product(a, a));
    const auto square_b = blurred(product(b, b));
    const auto mixed = blurred(product(a, b));
    double sum = 0;
    for (size_t y = kRadius; y < a.height_px - kRadius; ++y) {
        for (size_t x = kRadius; x < a.width_px - kRadius; ++x) {
            const size_t i = y * a.width_px + x;
            const double mu_a = mean_a.values[i];
            const double mu_b = mean_b.values[i];
            const double means = mu_a * mu_a + mu_b * mu_b;
            const double variances = square_a.values[i] + square_b.values[i] - means;
            const double covariance = mixed.values[i] - mu_a * mu_b;
            sum += (2 * mu_a * mu_b + kC1) * (2 * covariance + kC2) /
                   ((means + kC1) * (variances + kC2));
        }
    }
    return sum / static_cast<double>((a.width_px - 2 * kRadius) * (a.height_px - 2 * kRadius));
}

} // namespace froxel::image_metrics
