#include "bench/errors.h"

#include "bench/picture_scale.h"
#include "core/error.h"
#include "settings/ranges.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>
#include <utility>

namespace froxel::bench {

namespace {

// 9 ns a pair on two cores of a CPU device, a few ps in a GPU's compute stage (70 in its fragment
// stage).
constexpr double kR1PairsCpu = 2e9;
constexpr double kR1PairsGpu = 1e11;
constexpr double kR2PairsPerThread = 1e9;

bool isForward(settings::Renderer renderer) {
    return renderer == settings::Renderer::kNaive || renderer == settings::Renderer::kForwardPlus;
}

uint64_t areaOf(const settings::Size& size) {
    return uint64_t{size.width_px} * size.height_px;
}

uint32_t share(uint32_t part, uint32_t whole, uint32_t of) {
    return static_cast<uint32_t>(std::lround(static_cast<double>(of) * part / whole));
}

size_t lightCountOf(const settings::ViewSettings& settings, const scene::Scene& scene) {
    return settings.lights.count + (settings.lights.scene_lights ? scene.lights.size() : 0) +
           settings.lights.placed.lights().size();
}

Picture scaledTo(const Picture& picture, const settings::Size& size) {
    const settings::Size from{picture.linear.width_px, picture.linear.height_px};
    return {scaled(picture.linear, size), scaled(picture.rgba8, from, size), {}};
}

PictureError compare(const Picture& picture, const Picture& reference) {
    PictureError error;
    error.size = {picture.linear.width_px, picture.linear.height_px};
    error.linear = image_metrics::linearDifference(picture.linear, reference.linear);
    error.shown = image_metrics::shownDifference(picture.shown(), reference.shown());
    const bool tiled = picture.grid.x > 0;
    if (error.exact()) { // and so are the rest, which take longer
        error.tile_edge_ratio = tiled ? std::optional(0.0) : std::nullopt;
        return error;
    }
    error.perceived = image_metrics::perceivedDifference(picture.shown(), reference.shown());
    error.hdr_flip = image_metrics::hdrFlip(picture.linear, reference.linear);
    if (tiled) {
        error.tile_edge_ratio =
            image_metrics::tileEdgeRatio(picture.linear, reference.linear,
                                         {picture.grid.tile_width_px, picture.grid.tile_height_px});
    }
    return error;
}

PictureError skippedFor(std::string reason) {
    PictureError error;
    error.skipped = std::move(reason);
    return error;
}

// What cannot be drawn or shaded is left out and said; a lost device ends the run.
PictureError skippedFor(const Error& error) {
    if (error.code == ErrorCode::kDevice) {
        throw StartupError(error);
    }
    return skippedFor(error.message);
}

bool worse(const PictureError& a, const PictureError& b) {
    return a.linear.nonfinite_count != b.linear.nonfinite_count
               ? a.linear.nonfinite_count > b.linear.nonfinite_count
               : a.linear.max_abs > b.linear.max_abs;
}

} // namespace

ErrorOptions errorOptionsFor(bool device_is_cpu) {
    const double threads = std::max(1U, std::thread::hardware_concurrency());
    return {.r1_pairs_limit = device_is_cpu ? kR1PairsCpu : kR1PairsGpu,
            .r2_pairs_limit = kR2PairsPerThread * threads};
}

size_t
viewsWithin(double pairs_limit, const settings::Size& size, size_t light_count, size_t view_count) {
    const double pairs =
        static_cast<double>(areaOf(size)) * static_cast<double>(std::max<size_t>(light_count, 1));
    const double fit = std::floor(pairs_limit / pairs);
    return fit < static_cast<double>(view_count) ? static_cast<size_t>(fit) : view_count;
}

ErrorSizes errorSizes(const Row& row, const settings::Size& wanted) {
    const auto& drawn = row.settings.size;
    const auto shown = row.scaled_to.value_or(drawn);
    const auto compared = areaOf(shown) < areaOf(wanted) ? shown : wanted;
    return {compared,
            {share(drawn.width_px, shown.width_px, compared.width_px),
             share(drawn.height_px, shown.height_px, compared.height_px)}};
}

settings::ViewSettings r1Settings(settings::ViewSettings settings) {
    if (isForward(settings.renderer)) {
        settings.renderer = settings::Renderer::kNaive;
    }
    settings.light_loop = settings::LightLoop::kAllLights;
    settings.list_cap = 0;
    settings.grid = {};
    settings.count_pairs = false;
    return settings;
}

settings::ViewSettings r2Settings(settings::ViewSettings settings) {
    if (isForward(settings.renderer)) {
        settings.renderer = settings::Renderer::kClusteredDeferred;
    }
    settings.lighting = settings::LightingStage::kAuto;
    settings.gbuffer = {};
    settings.antialiasing = settings::Antialiasing::kNone;
    const settings::Fog volume; // which the reference has none of
    settings.fog.tile_px = volume.tile_px;
    settings.fog.slice_count = volume.slice_count;
    settings.fog.half_rate = volume.half_rate;
    settings.fog.noise = volume.noise;
    settings.transparency = {}; // blended surfaces are sorted pixel by pixel
    settings.peel_layers = settings::ViewSettings{}.peel_layers;
    settings.lights.cutoff = 0;
    settings.list_cap = 0;
    settings.grid = {};
    settings.light_loop = settings::LightLoop::kAuto;
    settings.count_pairs = false;
    return settings;
}

std::vector<size_t> ErrorMeter::viewsOf(const Row& row) const {
    if (row.only_view) {
        return {*row.only_view};
    }
    std::vector<size_t> views(base_.views.size());
    std::iota(views.begin(), views.end(), size_t{0});
    return views;
}

Result<Pictures::Shared> ErrorMeter::right(Reference reference,
                                           const Row& row,
                                           const settings::ViewSettings& drawn,
                                           const settings::Size& size,
                                           double time_s) {
    const Against against = reference == Reference::kR1 ? Against::kReference : row.against;
    const bool same_way = reference == Reference::kR1 || against == Against::kFullModel;
    settings::ViewSettings meant = same_way ? r1Settings(drawn) : r2Settings(drawn);
    meant.size = size;
    switch (against) {
    case Against::kReference:
        return same_way ? pictures_.drawOnce(meant, time_s) : pictures_.shadeOnce(meant, time_s);
    case Against::kSamples:
        return pictures_.sampleOnce(meant, time_s);
    case Against::kPeeled:
        meant.transparency = settings::Transparency::kPeeled;
        meant.peel_layers = settings::kPeelLayersRange.max;
        break;
    case Against::kFullModel:
        meant.geometry_error_px = 0;
        break;
    }
    return pictures_.drawOnce(meant, time_s);
}

PictureError ErrorMeter::against(Reference reference, const Row& row, Drawn& drawn) {
    if (row.settings.debug.view != settings::DebugView::kNone) {
        return skippedFor("a debug view has no error");
    }
    const bool is_r1 = reference == Reference::kR1;
    const auto sizes = errorSizes(row, options_.size);
    // R1 has the same inputs, so also the same size; R2 is what should be seen.
    const auto reference_size = is_r1 ? sizes.drawn : sizes.compared;
    auto views = viewsOf(row);
    const double limit = is_r1 ? options_.r1_pairs_limit : options_.r2_pairs_limit;
    const size_t light_count = lightCountOf(row.settings, scene_);
    views.resize(viewsWithin(limit, reference_size, light_count, views.size()));
    if (views.empty()) {
        return skippedFor(
            fmt::format("one view of {}x{} and {} lights costs more than {:.3g} pairs",
                        reference_size.width_px, reference_size.height_px, light_count, limit));
    }
    PictureError worst;
    for (const size_t view : views) {
        if (stop_) {
            return skippedFor("the run was stopped before");
        }
        auto settings = row.settings;
        settings.camera = base_.views[view].camera;
        settings.size = sizes.drawn;
        const double time_s = base_.views[view].time_s;
        if (!drawn.contains(view)) {
            drawn.emplace(view, pictures_.draw(settings, time_s));
        }
        const auto& picture = drawn.at(view);
        if (!picture) {
            return skippedFor(picture.error());
        }
        const auto meant = right(reference, row, settings, reference_size, time_s);
        if (!meant) {
            return skippedFor(meant.error());
        }
        const bool same_size = reference_size == sizes.drawn;
        auto error = same_size ? compare(**picture, **meant)
                               : compare(scaledTo(**picture, reference_size), **meant);
        error.view = view;
        if (worst.view_count == 0 || worse(error, worst)) {
            const size_t seen = worst.view_count;
            worst = error;
            worst.view_count = seen;
        }
        ++worst.view_count;
    }
    return worst;
}

RowErrors ErrorMeter::measure(const Row& row) {
    Drawn drawn;
    auto r1 = against(Reference::kR1, row, drawn);
    return {std::move(r1), against(Reference::kR2, row, drawn)};
}

} // namespace froxel::bench
