#include "app/drawing.h"

#include "app/camera_path_option.h"
#include "app/environment_file.h"
#include "app/scene_camera.h"
#include "app/scene_source.h"
#include "encode/image_file.h"
#include "motion/posed_scene.h"
#include "render/view/sample_mean.h"
#include "report/frame_step.h"
#include "settings/samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace froxel::app {

Outputs outputsOf(const RenderOptions& options) {
    return options.out.empty() || options.writesFolder() || !options.compare.empty()
               ? Outputs{}
               : encode::outputsOf(encode::imageFormatOf(options.out).value());
}

namespace {

render::RenderedFrame drawFrame(render::ViewRenderer& viewer, const render::FrameInputs& inputs) {
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
        still.frame = drawFrame(viewer, inputs);
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

TimedRun describeRun(const RenderOptions& options,
                     const scene::Scene& scene,
                     const gpu::DeviceTraits& device) {
    return {.device = report::summarize(device),
            .scene = options.scene,
            .settings = beginningOf(options.scene, scene, options.settings, options.given,
                                    options.look, device.is_cpu),
            .time_s = options.time_s,
            .step_s =
                report::lightStepS(options.settings.lights) / report::kFrameStepS / options.fps,
            .warmup_count = options.warmup_count,
            .frames = {}};
}

bool usesDetailLevels(const RenderOptions& options, const TimedRun& run) {
    return run.settings.geometry_error_px > 0 ||
           std::ranges::any_of(options.compare, [&](const session::SettingChanges& side) {
               return changed(options, run, side).settings.geometry_error_px > 0;
           });
}

} // namespace

session::SessionState
changed(const RenderOptions& options, const TimedRun& run, const session::SettingChanges& changes) {
    session::SessionState state{run.settings, options.encoding, {}, {{}, 1, false}, {}};
    for (const session::SettingChange& change : changes) {
        change.setting->set(state, change.value);
    }
    return state;
}

Drawing::Drawing(const RenderOptions& options)
    : scene_(readScene(options)), device_(options.device),
      run_(startOf(options, scene_, device_.traits())),
      playback_(scene_.motion, run_.settings.animation, 0),
      renderer_(device_,
                posed(options),
                {},
                {.detail_levels = usesDetailLevels(options, run_),
                 .geometry_cache = options.device.pipeline_cache.folder}) {
    if (!options.path.empty()) {
        path_ = readCameraPath(options.path, scene_, run_.settings.camera, options.path_seconds)
                    .value();
    }
}

uint32_t Drawing::pictureCount(const RenderOptions& options) const {
    return path_ ? std::max(1U, static_cast<uint32_t>(std::lround(path_->seconds() * options.fps)))
                 : options.frame_count;
}

Still Drawing::draw(const RenderOptions& options, TimedRun& run, const OnPicture& on_picture) {
    render::ViewRenderer viewer(renderer_);
    render::FrameInputs inputs{.settings = run.settings,
                               .time_s = run.time_s,
                               .playing = playback_.at(run.time_s),
                               .keep_surfaces = options.keep_surfaces};
    for (uint32_t i = 0; i < options.warmup_count; ++i) {
        drawFrame(viewer, inputs);
    }
    Still last;
    const uint32_t frame_count = pictureCount(options);
    for (uint32_t i = 0; i < frame_count; ++i) {
        inputs.time_s = run.time_s + i * run.step_s;
        inputs.playing = playback_.at(run.time_s + i / options.fps);
        inputs.outputs = i + 1 == frame_count ? outputsOf(options) : Outputs{};
        if (path_) {
            inputs.settings.camera = path_->at(i / options.fps);
        }
        last = drawStill(viewer, inputs, run.frames);
        if (on_picture) {
            on_picture(last, i);
        }
    }
    return last;
}

scene::Scene Drawing::readScene(const RenderOptions& options) {
    auto scene =
        loadScene(options.scene, options.choices, workOn, readingBy(options.sandbox)).value();
    surround(scene, readSurroundings(options.environment_file));
    logWarnings(scene);
    return scene;
}

TimedRun Drawing::startOf(const RenderOptions& options,
                          const scene::Scene& scene,
                          const gpu::DeviceTraits& device) {
    auto run = describeRun(options, scene, device);
    run.settings.animation.number = scene.motion ? motion::usualAnimation(*scene.motion) : 0;
    run.settings.material_variant = scene.material_variant;
    return run;
}

const scene::Scene& Drawing::posed(const RenderOptions& options) {
    if (const auto playing = playback_.at(run_.time_s)) {
        motion::placeCameras(scene_, playing->clips, playing->now_s);
    }
    settings::ViewSettings& settings = run_.settings;
    settings.camera = findCamera(options.camera, scene_, settings.size).value();
    auto& lens_shift = settings.camera.lens_shift;
    lens_shift = options.lens_shift.value_or(lens_shift);
    if (options.grid_camera) {
        settings.debug.grid_camera =
            findCamera(*options.grid_camera, scene_, settings.size).value();
    }
    return scene_;
}

} // namespace froxel::app
