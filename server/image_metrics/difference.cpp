#include "core/assert.h"
#include "image_metrics/picture_error.h"
#include "image_metrics/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <vector>

namespace froxel::image_metrics {

namespace {

Pixel unitPixel(const PixelView& view, uint32_t x, uint32_t y) {
    const auto [r, g, b] = bytesAt(view, x, y);
    return {static_cast<float>(r) / 255, static_cast<float>(g) / 255, static_cast<float>(b) / 255};
}

// Takes pixels one by one; needs memory for every channel's difference, for the percentile.
class DifferenceSum {
  public:
    DifferenceSum(uint64_t pixel_count, double peak) {
        stats_.pixel_count = pixel_count;
        stats_.peak = peak;
        differences_.reserve(3 * pixel_count);
    }

    void add(const Pixel& picture, const Pixel& reference) {
        if (!isFinite(picture) || !isFinite(reference)) {
            ++stats_.nonfinite_count;
            return;
        }
        stats_.differing_count += picture != reference ? 1U : 0U;
        for (size_t c = 0; c < 3; ++c) {
            const double b = reference[c];
            const double difference = std::abs(picture[c] - b);
            squares_ += difference * difference;
            relative_squares_ += difference * difference / (b * b + 0.01);
            differences_.push_back(static_cast<float>(difference));
        }
    }

    [[nodiscard]] DifferenceStats stats() && {
        const auto count = static_cast<double>(differences_.size());
        stats_.rmse = std::sqrt(squares_ / count);
        stats_.relative_rmse = std::sqrt(relative_squares_ / count);
        stats_.psnr_db = 20 * std::log10(stats_.peak / stats_.rmse);
        if (differences_.empty()) {
            stats_.max_abs = stats_.p999_abs = std::numeric_limits<double>::quiet_NaN();
            return stats_;
        }
        const size_t rank = (differences_.size() * 999 + 999) / 1000; // 1-based, rounded up
        const auto ranked = differences_.begin() + static_cast<std::ptrdiff_t>(rank - 1);
        std::nth_element(differences_.begin(), ranked, differences_.end());
        stats_.p999_abs = *ranked;
        stats_.max_abs = *std::max_element(ranked, differences_.end());
        return stats_;
    }

  private:
    DifferenceStats stats_;
    double squares_ = 0;
    double relative_squares_ = 0;
    std::vector<float> differences_;
};

// One kind of neighbours: across borders of tiles, or elsewhere.
struct Steps {
    double sum = 0;
    uint64_t count = 0;

    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

using PixelError = std::optional<std::array<double, 3>>; // nothing: a value is not finite

PixelError errorOf(const Pixel& picture, const Pixel& reference) {
    if (!isFinite(picture) || !isFinite(reference)) {
        return std::nullopt;
    }
    return {{double{picture[0]} - double{reference[0]}, double{picture[1]} - double{reference[1]},
             double{picture[2]} - double{reference[2]}}};
}

void addStep(Steps& steps, const PixelError& from, const PixelError& to) {
    if (!from || !to) {
        return;
    }
    for (size_t c = 0; c < 3; ++c) {
        steps.sum += std::abs((*to)[c] - (*from)[c]);
    }
    ++steps.count;
}

// `beyond`: whether a pixel counts; `at` gives the values of one.
template <class Picture, class Beyond, class At>
Differing countDiffering(const Picture& picture,
                         const Picture& reference,
                         const Beyond& beyond,
                         const At& at) {
    expectAlike(picture, reference);
    Differing differing;
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            if (!beyond(x, y)) {
                continue;
            }
            ++differing.count;
            if (!differing.first) {
                differing.first = {x, y, at(picture, x, y), at(reference, x, y)};
            }
        }
    }
    return differing;
}

} // namespace

Differing differing(const LinearImage& picture, const LinearImage& reference, double tolerance) {
    const auto at = [](const LinearImage& image, uint32_t x, uint32_t y) {
        return pixelAt(image, size_t{y} * image.width_px + x);
    };
    const auto beyond = [&](uint32_t x, uint32_t y) {
        const Pixel a = at(picture, x, y);
        const Pixel b = at(reference, x, y);
        // Of a value that is not finite no comparison holds.
        return !std::ranges::all_of(std::array{0, 1, 2}, [&](int c) {
            const auto i = static_cast<size_t>(c);
            return std::abs(double{a[i]} - double{b[i]}) <= tolerance;
        });
    };
    return countDiffering(picture, reference, beyond, at);
}

Differing differing(const PixelView& picture, const PixelView& reference, uint32_t tolerance) {
    const auto beyond = [&](uint32_t x, uint32_t y) {
        const auto a = bytesAt(picture, x, y);
        const auto b = bytesAt(reference, x, y);
        const auto off = [&](size_t c) { return static_cast<uint32_t>(std::abs(a[c] - b[c])); };
        return std::max({off(0), off(1), off(2)}) > tolerance;
    };
    return countDiffering(picture, reference, beyond, unitPixel);
}

DifferenceStats
linearDifference(const LinearImage& picture, const LinearImage& reference, double peak) {
    expectAlike(picture, reference);
    const size_t pixel_count = picture.rgb.size() / 3;
    DifferenceSum sum(pixel_count, peak);
    for (size_t i = 0; i < pixel_count; ++i) {
        sum.add(pixelAt(picture, i), pixelAt(reference, i));
    }
    return std::move(sum).stats();
}

DifferenceStats shownDifference(const PixelView& picture, const PixelView& reference) {
    expectAlike(picture, reference);
    DifferenceSum sum(uint64_t{picture.width_px} * picture.height_px, 1);
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            sum.add(unitPixel(picture, x, y), unitPixel(reference, x, y));
        }
    }
    return std::move(sum).stats();
}

double
tileEdgeRatio(const LinearImage& picture, const LinearImage& reference, const TileGrid& tiles) {
    expectAlike(picture, reference);
    FROXEL_ASSERT(tiles.width_px > 0 && tiles.height_px > 0, "tiles have a size");
    std::vector<PixelError> errors(picture.rgb.size() / 3);
    for (size_t i = 0; i < errors.size(); ++i) {
        errors[i] = errorOf(pixelAt(picture, i), pixelAt(reference, i));
    }
    Steps borders;
    Steps elsewhere;
    for (size_t y = 0; y < picture.height_px; ++y) {
        for (size_t x = 0; x < picture.width_px; ++x) {
            const size_t i = y * picture.width_px + x;
            if (x > 0) {
                addStep(x % tiles.width_px == 0 ? borders : elsewhere, errors[i - 1], errors[i]);
            }
            if (y > 0) {
                addStep(y % tiles.height_px == 0 ? borders : elsewhere,
                        errors[i - picture.width_px], errors[i]);
            }
        }
    }
    const bool any_error = std::any_of(errors.begin(), errors.end(), [](const auto& error) {
        return error && *error != std::array<double, 3>{};
    });
    if (!any_error) {
        return 0;
    }
    if (borders.count == 0 || elsewhere.count == 0 || borders.sum + elsewhere.sum == 0) {
        return 1;
    }
    return borders.mean() / elsewhere.mean();
}

} // namespace froxel::image_metrics
