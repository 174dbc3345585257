#include "app/options.h"

#include "app/command_builder.h"
#include "app/diff_arguments.h"
#include "app/load_arguments.h"
#include "app/option_sources.h"
#include "app/probe_arguments.h"
#include "app/serve_arguments.h"
#include "app/setting_options.h"
#include "app/suggestion.h"
#include "bench/presets.h"
#include "builtin_scene/spheres.h"
#include "core/error.h"
#include "core/text.h"
#include "encode/image_file.h"
#include "environment/reader.h"
#include "session/comparison.h"
#include "session/delivery_rows.h"
#include "session/session_context.h"
#include "session/settings.h"
#include "settings/ranges.h"
#include "settings/setting_rows.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace froxel::app {

namespace {

constexpr settings::Range<uint32_t> kFramesRange{"frames", 1, 100'000};
constexpr settings::Range<double> kFlipRange{"max_flip", 0, 1};
constexpr settings::Range<double> kFpsRange{"fps", 1, 1000};
constexpr settings::Range<double> kPathSecondsRange{"seconds", 0.1, 3600};
constexpr settings::Range<uint32_t> kPathStopsRange{"path_stops", 1, 1000};
constexpr settings::Range<uint32_t> kCrfRange{"crf", 0, 63};
constexpr settings::Range<uint32_t> kWarmupRange{"warmup", 0, 1000};

constexpr settings::Range<double> kSecondsPerRowRange{"seconds_per_row", 0.01, 86'400.0};
constexpr settings::Range<double> kPairsRange{"pairs", 0.0, 1e18};

constexpr const char* kExitCodes =
    "Exit codes: 0 success, 1 other error, 2 usage, 3 scene, 4 device, 5 address in use, 6 device "
    "lost while serving, 99 broken requirement of load. bench also exits with 1 if a picture is "
    "inexact or a compared run is slower, load if a viewer failed, and diff if pictures differ by "
    "more than is allowed. bench and load exit with 130 after a "
    "signal.";

// What the subcommands fill. The one that was given copies its own to `result`.
struct Targets {
    ServeOptions serve;
    RenderOptions render;
    RecordOptions record;
    BenchOptions bench;
    LoadOptions load;
    InfoOptions info;
    DiffOptions diff;
    SceneOptions scene;
    ProbeOptions probe;
    BakeOptions bake;
    std::optional<LogLevel> log_level;
    LogFormat log_format = LogFormat::kText;
    const Environment* environment = nullptr; // for what may be configured by it
    Options result;
};

std::string textOf(const settings::Size& size) {
    return fmt::format("{}x{}", size.width_px, size.height_px);
}

template <class Names, class Enum>
std::string textOf(const Names& names, Enum value) {
    return std::string(names[static_cast<size_t>(value)]);
}

std::string sizeHelp(const std::string& what) {
    return fmt::format("{} in pixels, {}x{} to {}x{}", what, settings::kWidthRange.min,
                       settings::kHeightRange.min, settings::kWidthRange.max,
                       settings::kHeightRange.max);
}

Result<std::filesystem::path> parsePicturePath(const std::string& text) {
    const std::filesystem::path path(text);
    if (path.filename().empty()) {
        return path; // a folder, which checkRender() judges
    }
    const auto format = encode::imageFormatOf(path);
    return format ? Result<std::filesystem::path>(path) : format.error();
}

Result<std::filesystem::path> parseWebmPath(const std::string& text) {
    const std::filesystem::path path(text);
    if (path.extension() != ".webm") {
        return Error{ErrorCode::kInvalidArgument, fmt::format("'{}' is not a .webm file", text)};
    }
    return path;
}

Result<std::filesystem::path> parseGlbPath(const std::string& text) {
    const std::filesystem::path path(text);
    if (path.extension() != ".glb") {
        return Error{ErrorCode::kInvalidArgument, fmt::format("'{}' is not a .glb file", text)};
    }
    return path;
}

void addSceneOption(CommandBuilder& command, std::string& target, const std::string& shown) {
    command.text("--scene", "PATH|builtin", target, shown,
                 "glTF 2.0, GLB, VRM, OBJ, PLY, STL or 3MF file, or the built-in hall");
}

void addSandbox(CommandBuilder& command, bake::Sandbox& target) {
    command.name("--sandbox", target, kSandboxNames,
                 "Process that reads scene files. off: this one. best: another one, without the "
                 "rights that the system can take from it. require: likewise, or none");
}

void addScenesFolder(CommandBuilder& command,
                     std::filesystem::path& target,
                     const std::string& help) {
    command.text("--scenes", "DIR", target, "", help)->check([](const std::string& folder) {
        std::error_code unknown;
        return std::filesystem::is_directory(folder, unknown)
                   ? std::string()
                   : "'" + printable(folder) + "' is not a folder";
    });
}

void addSceneChoices(CommandBuilder& command, SceneChoices& target) {
    constexpr const char* kForm = "NAME|NUMBER|none";
    command.text("--animation", kForm, target.animation, "the scene's first",
                 "Animation of the scene that plays, numbered from 1");
    command.text("--material-variant", kForm, target.material_variant, "none",
                 "Material variant of the scene, numbered from 1");
}

void addEnvironmentFile(CommandBuilder& command, std::filesystem::path& target) {
    command.text(
        "--environment-file", "FILE", target, "",
        fmt::format("Equirectangular panorama for the environment, .hdr or .exr, up to {}x{}",
                    environment::kMaxPanoramaWidth_px, environment::kMaxPanoramaWidth_px / 2));
}

void checkServe(const ServeOptions& options) {
    if (options.tls_certificate.empty() != options.tls_key.empty()) {
        throw CLI::RequiredError("--tls-cert FILE and --tls-key FILE, or neither");
    }
    if (options.first_view.environment.light == settings::EnvironmentLight::kFile &&
        options.environment_file.empty()) {
        throw CLI::RequiredError("--environment-file FILE, which --environment file shows");
    }
}

enum class Configured { kByCommandLine, kBySources };

// The last step of every subcommand.
template <class T>
void finish(CommandBuilder& command,
            const T& options,
            LogLevel default_level,
            Targets& targets,
            Configured configured = Configured::kByCommandLine) {
    command.name("--log-level", targets.log_level, kLogLevelNames,
                 textOf(kLogLevelNames, default_level), "Lowest level of log lines on stderr");
    command.name("--log-format", targets.log_format, kLogFormatNames,
                 "Format of log lines: text with key=value, or JSON objects");
    command.cli().callback([command, &options, default_level, &targets, configured] {
        Configuration configuration;
        if (configured == Configured::kBySources) {
            configuration = applySources(command, *targets.environment);
            checkServe(targets.serve);
        }
        targets.result = {options, targets.log_level.value_or(default_level), targets.log_format,
                          std::move(configuration)};
    });
}

void addLensShift(CommandBuilder& command, std::optional<glm::dvec2>& target) {
    command.value(
        "--lens-shift", "X,Y", target, parseLensShift, "the camera's",
        "Shift of the picture's centre off the view axis, right and up, in half pictures");
}

// A switch that takes a word, as it did before there was a table.
void addAdaptive(CommandBuilder& command,
                 const settings::SettingOf<session::DeliverySettings>& row,
                 session::DeliverySettings& delivery) {
    static constexpr std::array kSwitchNames = {std::string_view("off"), std::string_view("on")};
    command.name("--adaptive", delivery.adaptive, kSwitchNames, std::string(row.words.help));
}

void addDelivery(CommandBuilder& command, session::DeliverySettings& delivery) {
    for (const auto& row : session::kDeliveryRows) {
        if (row.kind == settings::SettingKind::kSwitch) {
            addAdaptive(command, row, delivery);
        } else {
            addSetting(command, row, delivery);
        }
    }
}

// What a viewer starts with; each may change it.
void addFirstView(CommandBuilder& command, ServeOptions& options) {
    using Defaults = session::SessionDefaults;
    command.value("--size", "WxH", options.size, parseSize,
                  byDevice([](const Defaults& d) { return textOf(d.settings.size); }),
                  sizeHelp("First picture"));
    addSettingValue(
        command, session::findSetting("quality")->facts(),
        byDevice([](const Defaults& d) { return fmt::format("{}", d.encoding.quality); }),
        [&options](const auto& value) { options.quality = std::get<uint32_t>(value); });
    addDelivery(command, options.delivery);
    command.group("First view: size and stream");
    addLook(command, options.look);
    addViewSettings(command, options.first_view, options.given, options.light_set);
    addLensShift(command, options.lens_shift);
    command.group("First view: look");
}

void addServe(CLI::App& app, Targets& targets) {
    auto& options = targets.serve;
    CommandBuilder command(
        app, "serve",
        "Serve a scene to browsers: the page, /healthz and /ws\n\n  froxel serve                   "
        "                 the built-in hall, at http://127.0.0.1:8080\n  froxel serve --scene "
        "model.glb --lights 5000    a model of your own, and more lights\n  froxel serve --scenes "
        "models/ --address 0.0.0.0 --allow-host NAME\n                                             "
        "     a folder of models, for other computers\n");
    addServeAddresses(command, options);
    command.group("Addresses and access");
    addSceneOption(command, options.scene, options.scene);
    addScenesFolder(command, options.scenes,
                    "Folder of scene files that viewers may switch to. The server notices "
                    "changes, and reads the folder again on SIGHUP");
    addSceneChoices(command, options.choices);
    addSandbox(command, options.sandbox);
    addEnvironmentFile(command, options.environment_file);
    command.cli().add_flag("--detail-levels", options.detail_levels,
                           "Make coarser levels of scenes while they load, for viewers who ask for "
                           "a geometry error. Loading takes longer");
    command.group("Scenes");
    command.device(options.device, options.validation);
    command.name("--jpeg-encoder", options.jpeg_encoder, stream::kJpegPlaceNames,
                 "Where JPEGs are made; auto: on a GPU that is faster than all encoder threads "
                 "together, else on the host. The files are the same");
    command.pipelineCache(options.pipeline_cache);
    command.group("Device");
    addServeLimits(command, options);
    command.group("Limits and times");
    addFirstView(command, options);
    finish(command, options, LogLevel::kInfo, targets, Configured::kBySources);
}

void addComparison(CommandBuilder& command, RenderOptions& options) {
    command.cli()
        .add_option_function<std::vector<std::string>>(
            "--compare",
            [&options](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    auto changes = session::parseRight(text == "as-set" ? "" : text);
                    if (!changes) {
                        throw CLI::ValidationError("--compare", changes.error().message);
                    }
                    options.compare.push_back(std::move(*changes));
                }
            },
            "Draw the same frame twice and measure the difference. Each value lists settings that "
            "one side has otherwise, such as \"renderer:naive,list_cap:16\"; as-set: none")
        ->expected(2)
        ->type_name("LEFT RIGHT");
    command.number("--split", options.compare_split, settings::kCompareSplitRange,
                   "Divider of the compared picture, as a share of the width");
    command.number("--max-flip", options.max_flip, kFlipRange, "none",
                   "Highest mean LDR-FLIP between the compared sides");
    command.group("Comparison");
}

CLI::Option* addPath(CommandBuilder& command, std::string& path, double& seconds) {
    auto* const option =
        command.text("--path", "FILE|turntable|flythrough", path, "",
                     "Path that the camera follows, once: a JSON file of key frames, round what "
                     "the view looks at, or through the scene's cameras");
    command.number("--path-seconds", seconds, kPathSecondsRange, "Duration of a built-in path");
    return option;
}

void addWarmup(CommandBuilder& command, RenderOptions& options) {
    command.number("--warmup", options.warmup_count, kWarmupRange,
                   "Frames drawn first and not counted");
}

void addOutputs(CommandBuilder& command, RenderOptions& options) {
    command.value("--out", "FILE", options.out, parsePicturePath, "",
                  "File for the last frame: .png, .jpg, or .exr or .pfm (linear, before exposure). "
                  "With --path also a folder for all frames: DIR/");
    auto& encoding = options.encoding;
    for (const auto& row : settings::kEncodingRows) {
        if (row.name == "quality" || row.name == "chroma") { // a file is no stream
            addSetting(command, row, encoding);
        }
    }
    auto* const frames =
        command.number("--frames", options.frame_count, kFramesRange, "Frames to draw");
    command.number("--fps", options.fps, kFpsRange, "Frames of a second of the lights' clock");
    addPath(command, options.path, options.path_seconds)->excludes(frames);
    addWarmup(command, options);
    command.cli().add_flag("--keep-surfaces", options.keep_surfaces,
                           "Reuse depth and G-buffer of the previous frame while they would not "
                           "change, as serve does. Otherwise each frame is drawn in full");
    command.text("--timings", "FILE", options.timings, "",
                 "File for the times of passes and frames, as JSON");
    command.group("Picture and files");
}

// What a picture shows, and on which device it is drawn.
void addPicture(CommandBuilder& command, RenderOptions& options) {
    auto& settings = options.settings;
    addSceneOption(command, options.scene, options.scene);
    addSceneChoices(command, options.choices);
    addSandbox(command, options.sandbox);
    addEnvironmentFile(command, options.environment_file);
    command.device(options.device.choice, options.device.validation);
    command.pipelineCache(options.device.pipeline_cache);
    command.group("Scene and device");
    addLook(command, options.look);
    addViewSettings(command, settings, options.given, options.light_set);
    command.group("Renderer");
    command.number("--time", options.time_s, settings::kTimeRange, "The lights' clock in seconds");
    command.value("--size", "WxH", settings.size, parseSize, textOf(settings.size),
                  sizeHelp("Picture"));
    command.value("--camera", "CAMERA", options.camera, parseCamera, "the scene's first",
                  "Name of a scene camera, or \"ex,ey,ez;tx,ty,tz;fov\" in metres and degrees");
    addLensShift(command, options.lens_shift);
    command.value(
        "--grid-camera", "CAMERA", options.grid_camera, parseCamera, "the view's",
        "Camera whose cluster grid --debug-view cluster_wires shows, in the form of --camera");
}

void addRender(CLI::App& app, Targets& targets) {
    auto& options = targets.render;
    CommandBuilder command(app, "render", "Draw a picture of a scene, or time its frames");
    addPicture(command, options);
    addOutputs(command, options);
    addComparison(command, options);
    finish(command, options, LogLevel::kWarn, targets);
}

void addRecord(CLI::App& app, Targets& targets) {
    auto& options = targets.record;
    CommandBuilder command(app, "record",
                           "Record a video of a scene: along a camera path, or from one view");
    addPicture(command, options.pictures);
    command.value("--out", "FILE.webm", options.out, parseWebmPath, "", "Video file (VP9 in WebM)")
        ->required();
    auto* const seconds =
        command.number("--seconds", options.seconds, kPathSecondsRange, "Duration without a path");
    command.number("--fps", options.pictures.fps, kFpsRange, "Frames of a second");
    addPath(command, options.pictures.path, options.pictures.path_seconds)->excludes(seconds);
    addWarmup(command, options.pictures);
    command.number("--crf", options.crf, kCrfRange,
                   "Constant quality of every frame, the best first");
    const auto& chroma =
        *std::ranges::find(settings::kEncodingRows, "chroma", &settings::Setting::name);
    addSetting(command, chroma, options.pictures.encoding);
    command.group("Video");
    finish(command, options, LogLevel::kWarn, targets);
}

void addBenchMethod(CommandBuilder& command, BenchOptions& options) {
    command.number("--seconds-per-row", options.seconds_per_row, kSecondsPerRowRange,
                   "Time for the frames of one row; rows that need more are skipped and listed");
    command.value("--error-size", "WxH", options.error_size, parseSize, textOf(options.error_size),
                  sizeHelp("Size of the pictures for errors"));
    command.number("--r1-pairs", options.r1_pairs_limit, kPairsRange,
                   "2e9 on a CPU device, 1e11 on a GPU",
                   "Maximum of (light, pixel) pairs for the exactness check of a row");
    command.number("--r2-pairs", options.r2_pairs_limit, kPairsRange, "1e9 a hardware thread",
                   "Maximum of (light, pixel) pairs for the reference in double");
}

void addBench(CLI::App& app, Targets& targets) {
    auto& options = targets.bench;
    CommandBuilder command(app, "bench", "Measure frame times and errors over sweeps of settings");
    command
        .text("--preset", "NAME", options.presets,
              "all but geometry_error, material_variants and smoke",
              "Sweep to measure, repeatable; --list names them")
        ->allow_extra_args(false)
        ->check([](const std::string& text) {
            const auto preset = parseName(text, bench::presetNames());
            return preset ? std::string() : preset.error().message;
        });
    command.cli().add_flag("--list", options.list, "Print the presets");
    command.cli()
        .add_option("--compare", options.compare,
                    "Print the rows of B that differ from A's by more than the noise")
        ->type_name("A.json B.json")
        ->expected(2);
    command.cli()
        .add_option("--join", options.join,
                    "Join results of one device, scene and method, with --out and --report")
        ->type_name("FILE.json...")
        ->expected(1, 1000);
    addSceneOption(command, options.scene, options.scene);
    addEnvironmentFile(command, options.environment_file);
    command.device(options.device.choice, options.device.validation);
    command.pipelineCache(options.device.pipeline_cache);
    auto* const cameras =
        command.text("--camera", "CAMERA", options.cameras, "the scene's first three",
                     "View to measure, in the form of render's --camera; repeatable, the first "
                     "one is timed");
    cameras->allow_extra_args(false)->check([](const std::string& text) {
        const auto camera = parseCamera(text);
        return camera ? std::string() : camera.error().message;
    });
    addPath(command, options.path, options.path_seconds)->excludes(cameras);
    command.number("--path-stops", options.path_stops, kPathStopsRange,
                   "Views along the path, at even times, in the place of --camera");
    command.value("--size", "WxH", options.settings.size, parseSize, textOf(options.settings.size),
                  sizeHelp("Picture"));
    addLights(command, options.settings, options.light_set);
    addBenchMethod(command, options);
    command.text("--out", "FILE", options.out, "", "JSON; see tests/bench/results/README.md");
    command.text("--report", "FILE", options.report, "", "HTML with plots, in one file");
    command.text("--web-root", "DIR", options.web_root, "web beside the binary, else the build's",
                 "Folder of the built page");
    finish(command, options, LogLevel::kWarn, targets);
}

void addLoad(CLI::App& app, Targets& targets) {
    CommandBuilder command(app, "load",
                           "Measure a running server with viewers that decode nothing");
    addLoadArguments(command, targets.load);
    finish(command, targets.load, LogLevel::kWarn, targets);
}

void addInfo(CLI::App& app, Targets& targets) {
    auto& options = targets.info;
    CommandBuilder command(app, "info", "Print the device, and the content and needs of a scene");
    addSceneOption(command, options.scene, "none");
    command.cli().add_option("FILE", options.scene, "Same as --scene; or a picture file");
    addScenesFolder(command, options.scenes,
                    "Print only a table of all scene files in this folder");
    addSandbox(command, options.sandbox);
    addEnvironmentFile(command, options.environment_file);
    command.device(options.device.choice, options.device.validation);
    command.cli().add_flag("--json", options.json, "Print JSON");
    finish(command, options, LogLevel::kWarn, targets);
}

void addScene(CLI::App& app, Targets& targets) {
    auto& options = targets.scene;
    CommandBuilder command(app, "scene", "Write a built-in scene to a file");
    command.value("--out", "FILE", options.out, parseGlbPath, "", "Binary glTF, .glb")->required();
    auto* const spheres =
        command.number("--spheres", options.spheres, builtin_scene::kSphereTrianglesRange,
                       "the hall", "A field of bumpy spheres with so many triangles instead");
    command
        .number("--copies", options.copies, builtin_scene::kSphereCopiesRange, "1",
                "How often each of the ten spheres is placed")
        ->needs(spheres);
    finish(command, options, LogLevel::kWarn, targets);
}

void addBake(CLI::App& app, Targets& targets) {
    auto& options = targets.bake;
    CommandBuilder command(app, "bake", "Read a scene for another froxel, with no rights");
    command.cli().add_flag("--self-test", options.self_test,
                           "Give up all rights, try to open a file, to connect and to execute, and "
                           "say whether each failed");
    command.cli()
        .add_flag("--reader", options.reader, "Read what the starting process asks for")
        ->group("");
    finish(command, options, LogLevel::kWarn, targets);
}

void checkBake(const BakeOptions& options) {
    if (!options.self_test && !options.reader) {
        throw CLI::RequiredError("--self-test; other froxels start it with descriptors");
    }
}

// What no single option can check.
void checkRender(const CLI::App& command, const RenderOptions& options) {
    if (options.out.empty() && options.timings.empty() && options.compare.empty()) {
        throw CLI::RequiredError("--out FILE, --timings FILE or both");
    }
    if (options.writesFolder() && options.path.empty()) {
        throw CLI::ValidationError(
            "--out", fmt::format("'{}' is a folder, which needs --path; without one, name a file",
                                 options.out.string()));
    }
    if (options.compare.empty() && options.max_flip) {
        throw CLI::ValidationError("--max-flip", "needs --compare");
    }
    if (!options.compare.empty() && options.writesFolder()) {
        throw CLI::ValidationError("--compare", "writes one picture, not a folder");
    }
    if (!options.compare.empty() && !options.out.empty() &&
        !encode::outputsOf(*encode::imageFormatOf(options.out)).none()) {
        throw CLI::ValidationError(
            "--compare", fmt::format("writes .png or .jpg, --out is '{}'", options.out.string()));
    }
    for (const char* name : {"--quality", "--chroma"}) {
        const bool jpeg = !options.out.empty() && !options.writesFolder() &&
                          *encode::imageFormatOf(options.out) == encode::ImageFormat::kJpeg;
        if (command.count(name) > 0 && !jpeg) {
            throw CLI::ValidationError(
                name, fmt::format("applies to .jpg only, --out is '{}'", options.out.string()));
        }
    }
}

// The view that needs it is the only one that looks at it.
void checkGridCamera(const RenderOptions& options) {
    if (options.grid_camera && options.settings.debug.view != settings::DebugView::kClusterWires) {
        throw CLI::ValidationError("--grid-camera", "applies to --debug-view cluster_wires only");
    }
}

void checkBench(const BenchOptions& options) {
    if (!options.list && options.compare.empty() && options.out.empty()) {
        throw CLI::RequiredError("--out FILE, --compare A.json B.json or --list");
    }
}

std::vector<std::string> commandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
    }
    return names;
}

std::vector<std::string> optionNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

// `command`: the subcommand that was given; null: none was.
std::string unexpected(const CLI::App& app, const CLI::App* command, const std::string& text) {
    const std::string name = text.substr(0, text.find('='));
    const bool option = name.starts_with("-");
    const std::string near =
        nearestOf(name, option               ? optionNames(command != nullptr ? *command : app)
                        : command == nullptr ? commandNames(app)
                                             : std::vector<std::string>());
    const std::string hint = near.empty() ? "" : "; did you mean " + near + "?";
    if (command == nullptr) {
        return fmt::format("froxel has no {} {}{}", option ? "option" : "command", printable(name),
                           hint);
    }
    return option ? fmt::format("froxel {} has no option {}{}", command->get_name(),
                                printable(name), hint)
                  : fmt::format("froxel {}: unexpected argument '{}'", command->get_name(),
                                printable(name));
}

std::string usageError(const CLI::App& app, const CLI::ParseError& error) {
    const auto given = app.get_subcommands();
    const CLI::App* command = given.empty() ? nullptr : given.front();
    std::string text = printable(error.what(), 2000);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        const auto extras = (command != nullptr ? *command : app).remaining();
        const auto option = std::ranges::find_if(
            extras, [](const std::string& extra) { return extra.starts_with("-"); });
        if (!extras.empty()) { // an option, whose value may be left over, too
            text = unexpected(app, command, option == extras.end() ? extras.front() : *option);
        }
    }
    return fmt::format("{} (see froxel{} --help)", text,
                       command != nullptr ? " " + command->get_name() : "");
}

} // namespace

Options parseOptions(int argc, const char* const* argv, const Environment& environment) {
    Targets targets;
    targets.environment = &environment;
    CLI::App app("Draws glTF scenes lit by thousands of lights and streams them to browsers.",
                 "froxel");
    app.set_version_flag("--version", "froxel " FROXEL_VERSION);
    app.set_help_all_flag("--help-all", "Print the help of every subcommand and exit");
    app.get_formatter()->column_width(36);
    app.footer(kExitCodes);
    app.require_subcommand(0, 1); // that one is needed is checked below, in better words
    addServe(app, targets);
    addRender(app, targets);
    addRecord(app, targets);
    addBench(app, targets);
    addLoad(app, targets);
    addInfo(app, targets);
    CommandBuilder diff(app, "diff", "Measure the difference between pictures, or folders of them");
    addDiffArguments(diff, targets.diff);
    finish(diff, targets.diff, LogLevel::kWarn, targets);
    addScene(app, targets);
    addBake(app, targets);
    CommandBuilder probe(app, "probe", "Ask a running server's health: exit code 0 or 1");
    addProbeArguments(probe, targets.probe);
    finish(probe, targets.probe, LogLevel::kWarn, targets);
    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty()) {
            throw CLI::RequiredError("a subcommand (serve, render, record, bench, load, info, "
                                     "diff, scene, bake or probe)");
        }
        if (const auto* render = std::get_if<RenderOptions>(&targets.result.command)) {
            checkRender(*app.get_subcommand("render"), *render);
            checkGridCamera(*render);
        }
        if (const auto* record = std::get_if<RecordOptions>(&targets.result.command)) {
            checkGridCamera(record->pictures);
        }
        if (const auto* bake = std::get_if<BakeOptions>(&targets.result.command)) {
            checkBake(*bake);
        }
        if (const auto* bench = std::get_if<BenchOptions>(&targets.result.command)) {
            checkBench(*bench);
        }
    } catch (const CLI::CallForVersion& version) {
        return {PrintText{std::string(version.what()) + "\n"}};
    } catch (const CLI::CallForAllHelp&) {
        return {PrintText{app.help("", CLI::AppFormatMode::All)}};
    } catch (const CLI::CallForHelp&) {
        return {PrintText{app.help()}};
    } catch (const CLI::ParseError& error) {
        throw StartupError({ErrorCode::kInvalidArgument, usageError(app, error)});
    }
    return std::move(targets.result);
}

} // namespace froxel::app
