#include "app/render_command.h"

#include "app/environment_file.h"
#include "app/output_file.h"
#include "app/scene_camera.h"
#include "app/scene_source.h"
#include "app/timings_report.h"
#include "encode/image_file.h"
#include "motion/posed_scene.h"
#include "render/view/renderer.h"
#include "render/view/sample_mean.h"
#include "report/frame_step.h"
#include "settings/samples.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <utility>
#include <vector>

namespace froxel::app {

namespace {

// That the picture's file is made of; none: pixels.
Outputs outputsOf(const RenderOptions& options) {
    return options.out.empty() ? Outputs{}
                               : encode::outputsOf(encode::imageFormatOf(options.out).value());
}

// A picture to be written.
struct Still {
    render::RenderedFrame frame;  // the last one
    std::vector<std::byte> rgba8; // the mean of several; empty: there was one
    LinearImage linear;           // where radiance is kept

    [[nodiscard]] PixelView pixels() const {
        PixelView view = frame.pixels.view();
        if (!rgba8.empty()) {
            view.data = rgba8.data();
            view.stride_bytes = size_t{4} * view.width_px;
        }
        return view;
    }
};

render::RenderedFrame draw(render::ViewRenderer& viewer, const render::FrameInputs& inputs) {
    viewer.submit(inputs).value();
    return std::move(viewer.collect()).value();
}

// In as many frames as it takes, each of which is timed.
Still drawStill(render::ViewRenderer& viewer,
                render::FrameInputs inputs,
                std::vector<FrameStats>& timed) {
    const settings::Camera camera = inputs.settings.camera;
    const uint32_t count = settings::framesOf(inputs.settings);
    Still still;
    render::SampleMean mean;
    for (uint32_t i = 0; i < count; ++i) {
        if (count > 1) {
            inputs.settings.camera = settings::sampled(camera, inputs.settings.size, i);
        }
        still.frame = draw(viewer, inputs);
        timed.push_back(still.frame.stats);
        if (count > 1) {
            mean.add(still.frame.pixels.view());
        }
        if (!inputs.outputs.none()) {
            addTo(still.linear, radianceOf(still.frame.pixels.view()),
                  1.0F / static_cast<float>(count));
        }
    }
    if (count > 1) {
        still.rgba8 = mean.take();
    }
    return still;
}

void writePicture(const RenderOptions& options, const Still& still) {
    if (!outputsOf(options).none()) {
        encode::writeRadiance(options.out, still.linear).value();
    } else {
        encode::writeImage(options.out, still.pixels(), options.encoding).value();
    }
}

TimedRun describeRun(const RenderOptions& options,
                     const scene::Scene& scene,
                     const gpu::DeviceTraits& device) {
    return {.device = report::summarize(device),
            .scene = options.scene,
            .settings = beginningOf(options.scene, scene, options.settings, options.given,
                                    options.look, device.is_cpu),
            .time_s = options.time_s,
            .step_s = report::lightStepS(options.settings.lights),
            .warmup_count = options.warmup_count,
            .frames = {}};
}

// Draws every picture and fills run.frames; returns the last one.
Still drawAll(const RenderOptions& options,
              const motion::Playback& playback,
              render::ViewRenderer& viewer,
              TimedRun& run) {
    render::FrameInputs inputs{.settings = run.settings,
                               .time_s = run.time_s,
                               .playing = playback.at(run.time_s),
                               .keep_surfaces = options.keep_surfaces};
    for (uint32_t i = 0; i < options.warmup_count; ++i) {
        draw(viewer, inputs);
    }
    Still last;
    for (uint32_t i = 0; i < options.frame_count; ++i) {
        inputs.time_s = run.time_s + i * run.step_s;
        inputs.playing = playback.at(run.time_s + i * report::kFrameStepS);
        inputs.outputs = i + 1 == options.frame_count ? outputsOf(options) : Outputs{};
        last = drawStill(viewer, inputs, run.frames);
    }
    return last;
}

// What the colours of a debug view say.
std::string legendLine(const DebugLegend& legend) {
    std::string line = fmt::format("{}: {}", legend.view, legend.words);
    if (!legend.colors.empty()) {
        line += fmt::format("; from {} to {} {} by #{:06x}", legend.min, legend.max, legend.unit,
                            fmt::join(legend.colors, ", #"));
    }
    return line;
}

// "12.3 ms" of a time of timingsReport().
std::string medianText(const nlohmann::ordered_json& time) {
    return time.is_null() ? "unknown"
                          : fmt::format("{:.1f} ms", time["median"].get<double>() / 1000);
}

} // namespace

void runRender(const RenderOptions& options) try {
    for (const auto* file : {&options.out, &options.timings}) {
        if (!file->empty()) {
            requireFolderOf(*file);
        }
    }
    auto scene =
        loadScene(options.scene, options.choices, workOn, readingBy(options.sandbox)).value();
    surround(scene, readSurroundings(options.environment_file));
    logWarnings(scene);
    gpu::Device device(options.device);
    auto run = describeRun(options, scene, device.traits());
    run.settings.animation.number = scene.motion ? motion::usualAnimation(*scene.motion) : 0;
    run.settings.material_variant = scene.material_variant;
    const motion::Playback playback(scene.motion, run.settings.animation, 0);
    if (const auto playing = playback.at(run.time_s)) {
        motion::placeCameras(scene, playing->clips, playing->now_s);
    }
    run.settings.camera = findCamera(options.camera, scene, run.settings.size).value();
    auto& lens_shift = run.settings.camera.lens_shift;
    lens_shift = options.lens_shift.value_or(lens_shift);
    if (options.grid_camera) {
        run.settings.debug.grid_camera =
            findCamera(*options.grid_camera, scene, run.settings.size).value();
    }
    render::Renderer renderer(device, scene, {},
                              {.detail_levels = run.settings.geometry_error_px > 0,
                               .geometry_cache = options.device.pipeline_cache.folder});
    render::ViewRenderer viewer(renderer);
    const auto last = drawAll(options, playback, viewer, run);
    if (!options.out.empty()) {
        writePicture(options, last);
    }
    const auto timings = timingsReport(run);
    if (!options.timings.empty()) {
        writeText(options.timings, timings.dump(2) + "\n");
    }
    const auto& frame = timings["frame"];
    fmt::print("{} of {}x{}: median {}; GPU {}, host {}\n",
               run.frames.size() == 1 ? "1 frame" : fmt::format("{} frames", run.frames.size()),
               run.settings.size.width_px, run.settings.size.height_px,
               medianText(frame["frame_us"]), medianText(frame["gpu_us"]),
               medianText(frame["host_us"]));
    if (last.frame.stats.details->legend) {
        fmt::print("{}\n", legendLine(*last.frame.stats.details->legend));
    }
    for (const auto* file : {&options.out, &options.timings}) {
        if (!file->empty()) {
            fmt::print("wrote {}\n", file->string());
        }
    }
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, fmt::format("Vulkan: {}", error.what())});
}

} // namespace froxel::app
