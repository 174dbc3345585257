#include "render/device_speed.h"

#include "render/scene_resources.h"

#include <algorithm>

namespace froxel::render {
namespace {

struct LitTime {
    double lighting_s = 0;
    double pairs = 0;
};

double lightingSeconds(const FrameStats& stats) {
    const auto pass = std::find_if(stats.passes.begin(), stats.passes.end(),
                                   [](const auto& p) { return p.name == "lighting"; });
    return pass == stats.passes.end() ? 0.0 : pass->gpu_us * 1e-6;
}

// The faster of some frames; the first compiles.
Result<LitTime> drawLit(ViewRenderer& view, const FrameInputs& inputs) {
    constexpr int kFrames = 4;
    LitTime best;
    for (int i = 0; i < kFrames; ++i) {
        if (auto submitted = view.submit(inputs); !submitted) {
            return submitted.error();
        }
        const auto frame = view.collect();
        if (!frame) {
            return frame.error();
        }
        const double seconds = lightingSeconds(frame->stats);
        best.lighting_s = i == 0 ? seconds : std::min(best.lighting_s, seconds);
        best.pairs = static_cast<double>(frame->stats.pairs.evaluated);
    }
    return best;
}

} // namespace

Result<double> measureSpeed(Renderer& renderer, bool device_is_cpu, const view::Camera& camera) {
    FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {320, 180};
    inputs.settings.light_loop = view::LightLoop::kAllLights;
    inputs.settings.lights.scene_lights = false;
    inputs.settings.lights.count = 1;
    inputs.settings.lights.radius_m = 1000;
    inputs.settings.count_pairs = true;
    ViewRenderer view(renderer);
    const auto dark = drawLit(view, inputs);
    if (!dark) {
        return dark.error();
    }
    inputs.settings.lights.count = device_is_cpu ? 200 : 20'000;
    const auto lit = drawLit(view, inputs);
    if (!lit) {
        return lit.error();
    }
    UnitCosts& unit = renderer.resources().unit_costs;
    const double pairs = lit->pairs - dark->pairs;
    const double seconds = lit->lighting_s - dark->lighting_s;
    if (pairs <= 0 || seconds <= 0) {
        return 1.0;
    }
    const double scale = seconds / pairs / unit.pair;
    unit = scaled(unit, scale);
    return scale;
}

} // namespace froxel::render
