// What a row's pictures are worth: their distance from both references, at every view.
#pragma once

#include "bench/picture.h"
#include "bench/sweep.h"
#include "image_metrics/picture_error.h"
#include "scene/scene.h"

#include <atomic>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace froxel::bench {

struct ErrorOptions {
    settings::Size size{640, 360}; // of pictures compared; a row's own where that is less
    // (light, pixel) pairs that a row's reference may cost, over all its views.
    double r1_pairs_limit = 0;
    double r2_pairs_limit = 0;
};

// Limits that a row's references keep in seconds, about: R1's on such a device, R2's on this host.
[[nodiscard]] ErrorOptions errorOptionsFor(bool device_is_cpu);

// Of the worst view, by linear.max_abs.
struct PictureError {
    std::string skipped; // why there is none, else empty
    settings::Size size;
    size_t view = 0;
    size_t view_count = 0;
    image_metrics::DifferenceStats linear;
    image_metrics::DifferenceStats shown;
    image_metrics::PerceivedStats perceived;
    double hdr_flip = 0;
    std::optional<double> tile_edge_ratio; // none: no grid, or scaled

    [[nodiscard]] bool exact() const {
        return linear.differing_count + linear.nonfinite_count + shown.differing_count == 0;
    }
};

struct RowErrors {
    PictureError r1;
    PictureError r2;
};

// How many of `view_count` views the limit allows. Pure.
[[nodiscard]] size_t
viewsWithin(double pairs_limit, const settings::Size& size, size_t light_count, size_t view_count);

// The size compared at, which the picture of a row with scaled_to is scaled to, and the size that
// the row is drawn at for it. Pure.
struct ErrorSizes {
    settings::Size compared;
    settings::Size drawn;
};
[[nodiscard]] ErrorSizes errorSizes(const Row& row, const settings::Size& wanted);

// The settings of R1: every light, in the same way. Pure.
[[nodiscard]] settings::ViewSettings r1Settings(settings::ViewSettings settings);
// The settings that R2 stands for: nothing traded for speed. Pure.
[[nodiscard]] settings::ViewSettings r2Settings(settings::ViewSettings settings);

class ErrorMeter {
  public:
    // All outlive it.
    ErrorMeter(render::Renderer& renderer,
               const scene::Scene& scene,
               const Base& base,
               const ErrorOptions& options,
               const std::atomic<bool>& stop)
        : pictures_(renderer, scene), scene_(scene), base_(base), options_(options), stop_(stop) {}

    // Throws StartupError where the device is lost.
    [[nodiscard]] RowErrors measure(const Row& row);
    // The picture that the row shows first, at its own size. Errors: those of ViewRenderer.
    [[nodiscard]] Result<Pictures::Shared> picture(const Row& row) {
        return pictures_.draw(row.settings, base_.views[row.timedView()].time_s);
    }

  private:
    enum class Reference { kR1, kR2 };
    using Drawn = std::map<size_t, Result<Pictures::Shared>>; // by view
    PictureError against(Reference reference, const Row& row, Drawn& drawn);
    // What the row, drawn by such settings, is held against.
    Result<Pictures::Shared> right(Reference reference,
                                   const Row& row,
                                   const settings::ViewSettings& drawn,
                                   const settings::Size& size,
                                   double time_s);
    [[nodiscard]] std::vector<size_t> viewsOf(const Row& row) const;

    Pictures pictures_;
    const scene::Scene& scene_;
    const Base& base_;
    ErrorOptions options_;
    const std::atomic<bool>& stop_;
};

} // namespace froxel::bench
