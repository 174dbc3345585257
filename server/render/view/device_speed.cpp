#include "render/view/device_speed.h"

#include "core/clock.h"
#include "core/keep_for_good.h"
#include "render/pipelines/pass_names.h"
#include "render/scene/scene_resources.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace froxel::render {
namespace {

// Times on the device. Where the driver does not tell those of passes, both are the frame's on the
// host's clock: lighting is taken as a difference of frames that differ in it alone.
struct Drawn {
    double lighting_s = 0;
    double all_s = 0; // of its passes
    double estimate_s = 0;
    double pairs = 0;
};

Result<RenderedFrame> drawWhole(ViewRenderer& view, uint32_t piece_count) {
    for (uint32_t piece = 0; piece < piece_count; ++piece) {
        if (auto submitted = view.submitPiece(); !submitted) {
            return submitted.error();
        }
        auto done = view.collectPiece();
        if (!done) {
            return done.error();
        }
        if (done->frame) {
            return std::move(*done->frame);
        }
    }
    return Error{ErrorCode::kDevice, "a frame of known lights was not drawn"};
}

// Seconds on the device, nothing where one is not known. `name` empty: of all passes.
std::optional<double> secondsOf(const std::vector<PassTime>& passes, std::string_view name = {}) {
    double seconds = 0;
    for (const PassTime& pass : passes) {
        if (!name.empty() && pass.name != name) {
            continue;
        }
        if (!pass.gpu_us) {
            return std::nullopt;
        }
        seconds += *pass.gpu_us * 1e-6;
    }
    return seconds;
}

// The fastest of some frames, of which the first compiles: enough of them take about as long, or
// something else holds the device up and more are tried. A device that is taken for ten times
// slower than it is would refuse every picture for as long as the server runs.
Result<Drawn> draw(ViewRenderer& view, const FrameInputs& inputs) {
    constexpr size_t kFewest = 4;
    constexpr size_t kMost = 48;
    constexpr size_t kAlike = 3;
    constexpr double kAlikeWithin = 1.2;
    constexpr Seconds kPatience{0.5};
    Drawn best;
    std::vector<double> all_s;
    const TimePoint begin = Clock::now();
    const auto settled = [&] {
        return std::count_if(all_s.begin(), all_s.end(), [&](double seconds) {
                   return seconds <= kAlikeWithin * best.all_s;
               }) >= static_cast<std::ptrdiff_t>(kAlike);
    };
    while (all_s.size() < kFewest ||
           (!settled() && all_s.size() < kMost && Clock::now() - begin < kPatience)) {
        const auto work = view.begin(inputs);
        if (!work) {
            return work.error();
        }
        const auto frame = drawWhole(view, work->piece_count);
        if (!frame) {
            return frame.error();
        }
        const FrameStats& stats = frame->stats;
        const double frame_s = stats.frame_us * 1e-6;
        const auto passes_s = secondsOf(stats.passes);
        const Drawn drawn{.lighting_s =
                              passes_s ? secondsOf(stats.passes, pass::kLighting).value() : frame_s,
                          .all_s = passes_s.value_or(frame_s),
                          .estimate_s = work->estimate.count(),
                          .pairs = stats.steps.find("pairs", "evaluated").value_or(0)};
        best = all_s.empty() || drawn.all_s < best.all_s ? drawn : best;
        all_s.push_back(drawn.all_s);
    }
    return best;
}

// Nothing where the lights took no longer than none did: something else has kept the device.
Result<std::optional<DeviceSpeed>>
tryMeasuring(ViewRenderer& view, FrameInputs inputs, bool device_is_cpu, const UnitCosts& unit) {
    std::array<Drawn, 3> drawn; // without lights, with, surfaces alone
    const std::array<uint32_t, 3> lights = {1, device_is_cpu ? 200U : 20'000U, 0};
    for (size_t i = 0; i < drawn.size(); ++i) {
        inputs.settings.lights.count = lights[i];
        inputs.settings.debug.view =
            lights[i] == 0 ? settings::DebugView::kBaseColor : settings::DebugView::kNone;
        auto done = draw(view, inputs);
        if (!done) {
            return done.error();
        }
        drawn[i] = *done;
    }
    const auto& [dark, lit, surfaces] = drawn;
    const double pairs = lit.pairs - dark.pairs;
    const double seconds = lit.lighting_s - dark.lighting_s;
    if (!(pairs > 0 && seconds > 0)) {
        return std::optional<DeviceSpeed>();
    }
    return std::optional(DeviceSpeed{.lights = seconds / pairs / unit.compute.pair,
                                     .surfaces = surfaces.all_s / surfaces.estimate_s});
}

} // namespace

Result<DeviceSpeed>
measureSpeed(Renderer& renderer, bool device_is_cpu, const settings::Camera& camera) {
    FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {320, 180};
    inputs.settings.light_loop = settings::LightLoop::kAllLights;
    inputs.settings.lights.scene_lights = false;
    inputs.settings.lights.radius_m = 1000;
    inputs.settings.count_pairs = true;
    auto view = std::make_unique<ViewRenderer>(renderer);
    UnitCosts& unit = renderer.resources().shared.unit_costs;
    constexpr int kAttempts = 5;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const auto speed = tryMeasuring(*view, inputs, device_is_cpu, unit);
        if (!speed) {
            keepForGood(std::move(view)); // a lost device may still use it
            return speed.error();
        }
        if (*speed) {
            unit = scaled(unit, (*speed)->lights, (*speed)->surfaces);
            return **speed;
        }
    }
    return DeviceSpeed{};
}

} // namespace froxel::render
