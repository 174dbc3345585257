#include "bench/run.h"

#include "bench/progress.h"
#include "core/clock.h"
#include "render/frame/frame_plan.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/view/renderer.h"

#include <cstddef>
#include <optional>
#include <utility>

namespace froxel::bench {

namespace {

constexpr size_t kEncodeCount = 20;

bool isDeferred(settings::Renderer renderer) {
    return renderer != settings::Renderer::kNaive && renderer != settings::Renderer::kForwardPlus;
}

std::optional<uint32_t> gbufferBytes(const settings::ViewSettings& settings,
                                     const render::SceneNeeds& needs) {
    if (!isDeferred(settings.renderer)) {
        return std::nullopt;
    }
    const bool lambert = settings.shading == settings::ShadingModel::kLambert;
    return render::gbufferBytesPerPixel(settings.gbuffer,
                                        lambert ? needs.wide_lambert : needs.wide_gbuffer,
                                        render::storesSpecular(settings, needs.specular));
}

} // namespace

void Run::measure(std::vector<Sweep> sweeps, const std::function<void(const RunResult&)>& save) {
    size_t row_count = 0;
    for (const auto& sweep : sweeps) {
        row_count += sweep.rows.size();
    }
    Progress progress(static_cast<double>(row_count));
    Runner runner(renderer_, result_.budget, stop_, progress);
    ErrorMeter meter(renderer_, scene_, result_.base, result_.error_options, stop_);
    const auto start = Clock::now();
    for (auto& sweep : sweeps) {
        auto times = runner.time(sweep, result_.base);
        SweepResult found{std::move(sweep), {}};
        for (size_t i = 0; i < times.size(); ++i) {
            const auto& row = found.sweep.rows[i];
            progress.at(found.sweep.name, "errors of " + row.series + ", " + row.label);
            found.rows.push_back(finish(row, std::move(times[i]), meter));
            progress.done(Progress::kErrorShare);
        }
        result_.sweeps.push_back(std::move(found));
        result_.elapsed_s = Seconds(Clock::now() - start).count();
        result_.complete = result_.sweeps.size() == sweeps.size() && !stop_;
        save(result_);
    }
}

RowResult Run::finish(const Row& row, RowTimes times, ErrorMeter& meter) const {
    RowResult result{std::move(times), {}, gbufferBytes(row.settings, needs_), {}};
    if (result.times.measured()) {
        result.errors = meter.measure(row);
        if (row.stream && !stop_) {
            const auto picture = meter.picture(row).value();
            result.stream = measureStream(picture->shown(), *row.stream, kEncodeCount).value();
        }
    }
    return result;
}

} // namespace froxel::bench
