// Separable filters over one channel of a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::image_metrics {

// [height][width], top row first.
template <class Value>
struct Plane {
    size_t width_px = 0;
    size_t height_px = 0;
    std::vector<Value> values;

    [[nodiscard]] std::span<const Value> row(size_t y) const {
        return {values.data() + y * width_px, width_px};
    }
    [[nodiscard]] std::span<Value> row(size_t y) {
        return {values.data() + y * width_px, width_px};
    }
};

// exp(-x^2 / (2 sigma^2)) at x = -radius .. radius, summing to 1.
[[nodiscard]] std::vector<double> gaussianKernel(size_t radius, double sigma);

// Correlation along rows or columns with a kernel of odd size; beyond its border a picture repeats
// its border pixels. Value is float or double.
template <class Value>
[[nodiscard]] Plane<Value> filterRows(const Plane<Value>& plane, std::span<const double> kernel);
template <class Value>
[[nodiscard]] Plane<Value> filterColumns(const Plane<Value>& plane, std::span<const double> kernel);

} // namespace froxel::image_metrics
