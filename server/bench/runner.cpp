#include "bench/runner.h"

#include "core/clock.h"
#include "core/cpu_time.h"
#include "core/error.h"
#include "encode/host_form.h"
#include "render/view/renderer.h"
#include "report/frame_step.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace froxel::bench {

namespace {

constexpr const char* kStopped = "the run was stopped before";

double secondsSince(TimePoint start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

Result<FrameStats> drawFrame(render::ViewRenderer& viewer, const render::FrameInputs& inputs) {
    const auto submitted = viewer.submit(inputs);
    if (!submitted) {
        return submitted.error();
    }
    auto frame = viewer.collect();
    if (!frame) {
        return frame.error();
    }
    return std::move(frame->stats);
}

void add(RowTimes& times, FrameStats stats, double cpu_us) {
    if (stats.gpu_us) {
        times.gpu_us.push_back(*stats.gpu_us);
    }
    times.host_us.push_back(stats.host_us);
    times.frame_us.push_back(stats.frame_us);
    times.cpu_us.push_back(cpu_us);
    for (const auto& pass : stats.passes) {
        auto known = std::ranges::find(times.passes, pass.name, &RowTimes::Pass::name);
        if (known == times.passes.end()) {
            known = times.passes.insert(known, {pass.name, 0, {}});
        }
        ++known->frame_count;
        if (pass.gpu_us) {
            known->gpu_us.push_back(*pass.gpu_us);
        }
    }
    times.last = std::move(stats);
}

// What this device cannot draw is left out and said; a lost device ends the run.
void skip(RowTimes& times, const Error& error) {
    if (error.code == ErrorCode::kDevice) {
        throw StartupError(error);
    }
    times.skipped = error.message;
}

} // namespace

Result<render::FrameInputs> Runner::inputsFor(const Row& row, double time_s) {
    auto form = row.form ? encode::hostForm(jpeg_formats_, *row.form) : HostForm();
    if (!form) {
        return form.error();
    }
    return render::FrameInputs{.settings = row.settings,
                               .time_s = time_s,
                               .keep_surfaces = row.keep_surfaces,
                               .form = std::move(*form)};
}

uint32_t Runner::warmUp(const Row& row, double time_s, RowTimes& times, double& frame_s) {
    const double warmup_s = budget_.seconds_per_row / 4;
    render::ViewRenderer viewer(renderer_);
    const auto inputs = inputsFor(row, time_s);
    if (!inputs) {
        skip(times, inputs.error());
        return 0;
    }
    const auto start = Clock::now();
    for (uint32_t i = 0; i < budget_.warmup_first; ++i) {
        const auto frame_start = Clock::now();
        const auto stats = drawFrame(viewer, *inputs);
        if (!stats) {
            skip(times, stats.error());
            return 0;
        }
        const double elapsed_s = secondsSince(frame_start);
        frame_s = i <= 1 ? elapsed_s : std::min(frame_s, elapsed_s);
        if (stop_ || (i + 1 >= kProbeFrames && secondsSince(start) > warmup_s)) {
            break;
        }
    }
    const auto fit = framesThatFit(frame_s, budget_);
    (fit.count == 0 ? times.skipped : times.note) = fit.remark;
    return fit.count;
}

std::vector<uint32_t>
Runner::warmUpAll(const Sweep& sweep, const Base& base, std::vector<RowTimes>& times) {
    std::vector<uint32_t> counts(sweep.rows.size(), 0);
    std::map<std::string, KnownFrame> known; // by series
    for (size_t i = 0; i < sweep.rows.size(); ++i) {
        const auto& row = sweep.rows[i];
        progress_.at(sweep.name, "warming up " + row.series + ", " + row.label);
        const auto before = known.find(row.series);
        const double work = workOf(row.settings);
        const auto refusal = refusalByPrediction(
            before == known.end() ? std::nullopt : std::optional(before->second), work, budget_);
        if (stop_) {
            times[i].skipped = kStopped;
        } else if (refusal) {
            times[i].skipped = *refusal;
        } else {
            double frame_s = 0;
            counts[i] = warmUp(row, base.views[row.timedView()].time_s, times[i], frame_s);
            if (frame_s > 0) {
                known[row.series] = {frame_s, work};
            }
        }
        progress_.done(Progress::kWarmupShare);
    }
    return counts;
}

void Runner::draw(const Turn& turn, const Row& row, double time_s, RowTimes& times) {
    render::ViewRenderer viewer(renderer_);
    auto inputs = inputsFor(row, time_s);
    if (!inputs) {
        return skip(times, inputs.error());
    }
    const auto timeOf = [&](uint32_t frame) {
        return time_s + frame * report::lightStepS(row.settings.lights);
    };
    for (uint32_t i = 0; i < budget_.warmup_frames + turn.frame_count && !stop_; ++i) {
        const bool counts = i >= budget_.warmup_frames;
        inputs->time_s = timeOf(turn.first_frame + (counts ? i - budget_.warmup_frames : 0));
        const auto cpu = processTime();
        auto stats = drawFrame(viewer, *inputs);
        if (!stats) {
            return skip(times, stats.error());
        }
        if (counts) {
            add(times, std::move(*stats), Microseconds(processTime() - cpu).count());
        }
    }
}

std::vector<RowTimes> Runner::time(const Sweep& sweep, const Base& base) {
    std::vector<RowTimes> times(sweep.rows.size());
    const auto counts = warmUpAll(sweep, base, times);
    const auto turns = interleaved(counts, budget_.rounds);
    const double share = static_cast<double>(sweep.rows.size()) * Progress::kTimingShare /
                         static_cast<double>(std::max<size_t>(turns.size(), 1));
    for (const auto& turn : turns) {
        if (stop_) {
            break;
        }
        const auto& row = sweep.rows[turn.row];
        progress_.at(sweep.name, row.series + ", " + row.label);
        draw(turn, row, base.views[row.timedView()].time_s, times[turn.row]);
        progress_.done(share);
    }
    for (size_t i = 0; i < times.size(); ++i) {
        if (stop_ && times[i].skipped.empty() && times[i].frame_us.size() < counts[i]) {
            (times[i].measured() ? times[i].note : times[i].skipped) = kStopped;
        }
    }
    return times;
}

} // namespace froxel::bench
