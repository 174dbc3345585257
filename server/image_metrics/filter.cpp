#include "image_metrics/filter.h"

#include "core/assert.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace froxel::image_metrics {

namespace {

// The inner loop of both directions: compilers vectorise it, and its sums have one order.
template <class Value>
void addScaled(std::span<Value> sum, const Value* term, Value factor) {
    for (size_t i = 0; i < sum.size(); ++i) {
        sum[i] += factor * term[i];
    }
}

template <class Value>
Plane<Value> zerosLike(const Plane<Value>& plane) {
    return {plane.width_px, plane.height_px, std::vector<Value>(plane.values.size())};
}

} // namespace

std::vector<double> gaussianKernel(size_t radius, double sigma) {
    std::vector<double> kernel(2 * radius + 1);
    for (size_t i = 0; i < kernel.size(); ++i) {
        const double x = static_cast<double>(i) - static_cast<double>(radius);
        kernel[i] = std::exp(-x * x / (2 * sigma * sigma));
    }
    const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
    for (double& weight : kernel) {
        weight /= sum;
    }
    return kernel;
}

template <class Value>
Plane<Value> filterRows(const Plane<Value>& plane, std::span<const double> kernel) {
    FROXEL_ASSERT(kernel.size() % 2 == 1, "a filter needs a middle");
    const size_t radius = kernel.size() / 2;
    Plane<Value> filtered = zerosLike(plane);
    std::vector<Value> padded(plane.width_px + 2 * radius);
    for (size_t y = 0; y < plane.height_px; ++y) {
        const auto from = plane.row(y);
        const auto middle = padded.begin() + static_cast<std::ptrdiff_t>(radius);
        std::fill(padded.begin(), middle, from.front());
        std::fill(std::copy(from.begin(), from.end(), middle), padded.end(), from.back());
        for (size_t k = 0; k < kernel.size(); ++k) {
            addScaled(filtered.row(y), padded.data() + k, static_cast<Value>(kernel[k]));
        }
    }
    return filtered;
}

template <class Value>
Plane<Value> filterColumns(const Plane<Value>& plane, std::span<const double> kernel) {
    FROXEL_ASSERT(kernel.size() % 2 == 1, "a filter needs a middle");
    const size_t radius = kernel.size() / 2;
    Plane<Value> filtered = zerosLike(plane);
    for (size_t y = 0; y < plane.height_px; ++y) {
        for (size_t k = 0; k < kernel.size(); ++k) {
            const size_t below = std::min(y + k, plane.height_px - 1 + radius);
            const size_t from = below > radius ? below - radius : 0;
            addScaled(filtered.row(y), plane.row(from).data(), static_cast<Value>(kernel[k]));
        }
    }
    return filtered;
}

template Plane<float> filterRows(const Plane<float>&, std::span<const double>);
template Plane<float> filterColumns(const Plane<float>&, std::span<const double>);
template Plane<double> filterRows(const Plane<double>&, std::span<const double>);
template Plane<double> filterColumns(const Plane<double>&, std::span<const double>);

} // namespace froxel::image_metrics
