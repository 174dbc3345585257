#include "app/render_command.h"

#include "app/camera_path_option.h"
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
#include "session/compared_report.h"
#include "session/comparison.h"
#include "session/session_state.h"
#include "settings/samples.h"
#include "stream/compared_picture.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

namespace froxel::app {

namespace {

// That the picture's file is made of; none: pixels.
Outputs outputsOf(const RenderOptions& options) {
    return options.out.empty() || options.writesFolder() || !options.compare.empty()
               ? Outputs{}
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
            .step_s =
                report::lightStepS(options.settings.lights) / report::kFrameStepS / options.fps,
            .warmup_count = options.warmup_count,
            .frames = {}};
}

// FOLDER/00001.png and so on.
void writeFrame(const RenderOptions& options, const Still& still, uint32_t index) {
    const auto file = options.out / fmt::format("{:05}.png", index + 1);
    encode::writeImage(file, still.pixels(), options.encoding).value();
}

uint32_t frameCountOf(const RenderOptions& options, const path::CameraPath* path) {
    return path == nullptr
               ? options.frame_count
               : std::max(1U, static_cast<uint32_t>(std::lround(path->seconds() * options.fps)));
}

// Draws every picture and fills run.frames; returns the last one. `path`: null: the camera rests.
Still drawAll(const RenderOptions& options,
              const motion::Playback& playback,
              const path::CameraPath* path,
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
    const uint32_t frame_count = frameCountOf(options, path);
    for (uint32_t i = 0; i < frame_count; ++i) {
        inputs.time_s = run.time_s + i * run.step_s;
        inputs.playing = playback.at(run.time_s + i / options.fps);
        inputs.outputs = i + 1 == frame_count ? outputsOf(options) : Outputs{};
        if (path != nullptr) {
            inputs.settings.camera = path->at(i / options.fps);
        }
        last = drawStill(viewer, inputs, run.frames);
        if (options.writesFolder()) {
            writeFrame(options, last, i);
        }
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

// Of settings that have these otherwise.
session::SessionState
changed(const RenderOptions& options, const TimedRun& run, const session::SettingChanges& changes) {
    session::SessionState state{run.settings, options.encoding, {}, {{}, 1, false}, {}};
    for (const session::SettingChange& change : changes) {
        change.setting->set(state, change.value);
    }
    return state;
}

bool usesDetailLevels(const RenderOptions& options, const TimedRun& run) {
    return run.settings.geometry_error_px > 0 ||
           std::ranges::any_of(options.compare, [&](const session::SettingChanges& side) {
               return changed(options, run, side).settings.geometry_error_px > 0;
           });
}

// The scene on the device, and the run that a picture of it begins with.
class Drawing {
  public:
    explicit Drawing(const RenderOptions& options)
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

    [[nodiscard]] const TimedRun& start() const { return run_; }
    // Draws every picture and fills run.frames; returns the last one.
    [[nodiscard]] Still draw(const RenderOptions& options, TimedRun& run) {
        render::ViewRenderer viewer(renderer_);
        return drawAll(options, playback_, path_ ? &*path_ : nullptr, viewer, run);
    }

  private:
    static scene::Scene readScene(const RenderOptions& options) {
        auto scene =
            loadScene(options.scene, options.choices, workOn, readingBy(options.sandbox)).value();
        surround(scene, readSurroundings(options.environment_file));
        logWarnings(scene);
        return scene;
    }
    static TimedRun startOf(const RenderOptions& options,
                            const scene::Scene& scene,
                            const gpu::DeviceTraits& device) {
        auto run = describeRun(options, scene, device);
        run.settings.animation.number = scene.motion ? motion::usualAnimation(*scene.motion) : 0;
        run.settings.material_variant = scene.material_variant;
        return run;
    }
    // Cameras as they stand at that time.
    const scene::Scene& posed(const RenderOptions& options) {
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

    scene::Scene scene_;
    gpu::Device device_;
    TimedRun run_;
    const motion::Playback playback_;
    render::Renderer renderer_;
    std::optional<path::CameraPath> path_;
};

void printTimes(const TimedRun& run, const nlohmann::ordered_json& timings) {
    const auto& frame = timings["frame"];
    fmt::print("{} of {}x{}: median {}; GPU {}, host {}\n",
               run.frames.size() == 1 ? "1 frame" : fmt::format("{} frames", run.frames.size()),
               run.settings.size.width_px, run.settings.size.height_px,
               medianText(frame["frame_us"]), medianText(frame["gpu_us"]),
               medianText(frame["host_us"]));
}

void tellFiles(const RenderOptions& options) {
    for (const auto* file : {&options.out, &options.timings}) {
        if (!file->empty()) {
            fmt::print("wrote {}\n", file->string());
        }
    }
}

void drawOne(const RenderOptions& options, Drawing& drawing) {
    TimedRun run = drawing.start();
    const auto last = drawing.draw(options, run);
    if (!options.out.empty() && !options.writesFolder()) {
        writePicture(options, last);
    }
    const auto timings = timingsReport(run);
    if (!options.timings.empty()) {
        writeText(options.timings, timings.dump(2) + "\n");
    }
    printTimes(run, timings);
    if (last.frame.stats.details->legend) {
        fmt::print("{}\n", legendLine(*last.frame.stats.details->legend));
    }
}

// Draws both sides of the same frames, one after the other.
int drawBoth(const RenderOptions& options, Drawing& drawing) {
    std::array<PixelLease, 2> sides;
    std::array<settings::Encoding, 2> encodings;
    nlohmann::ordered_json report = {{"schema", "froxel.compare.v1"}};
    std::optional<session::SessionState> left;
    for (size_t i = 0; i < sides.size(); ++i) {
        TimedRun run = drawing.start();
        const auto state = changed(options, run, options.compare[i]);
        run.settings = state.settings;
        encodings[i] = state.encoding;
        Still still = drawing.draw(options, run);
        const PixelView pixels = still.pixels();
        sides[i] = owningLease(pixels, std::move(still));
        const char* name = i == 0 ? "left" : "right";
        report[name] = timingsReport(run);
        fmt::print("{}: {}: ", name,
                   options.compare[i].empty() ? "as set" : session::textOf(options.compare[i]));
        printTimes(run, report[name]);
        if (i == 0) {
            left = state;
        }
    }
    left->comparison = session::Comparison{options.compare[1]};
    session::ComparedRecord record;
    record.promised = options.compare[0].empty() && session::promisesEqualBits(*left);
    stream::ComparedSides both{.left = std::move(sides[0]),
                               .divided = true,
                               .split = options.compare_split,
                               .left_encoding = encodings[0],
                               .right_encoding = encodings[1],
                               .flip_wanted = true};
    const PixelLease picture = stream::compose(both, std::move(sides[1]), record);
    const PixelView& pixels = picture.view();
    const uint64_t pixel_count = uint64_t{pixels.width_px} * pixels.height_px;
    fmt::print("{}\n", session::wordsOf(record, pixel_count));
    if (!options.out.empty()) {
        encode::writeImage(options.out, pixels, options.encoding).value();
    }
    if (!options.timings.empty()) {
        report["compared"] = session::comparedReport(record, pixel_count);
        writeText(options.timings, report.dump(2) + "\n");
    }
    return record.flip.value_or(0) > options.max_flip.value_or(1) ? 1 : 0;
}

} // namespace

int runRender(const RenderOptions& options) try {
    if (options.writesFolder()) {
        std::error_code failure; // writing says what is wrong
        std::filesystem::create_directories(options.out, failure);
    }
    for (const auto* file : {&options.out, &options.timings}) {
        if (!file->empty()) {
            requireFolderOf(*file);
        }
    }
    Drawing drawing(options);
    int exit_code = 0;
    if (options.compare.empty()) {
        drawOne(options, drawing);
    } else {
        exit_code = drawBoth(options, drawing);
    }
    tellFiles(options);
    return exit_code;
} catch (const vk::SystemError& error) {
    throw StartupError({ErrorCode::kDevice, fmt::format("Vulkan: {}", error.what())});
}

} // namespace froxel::app
