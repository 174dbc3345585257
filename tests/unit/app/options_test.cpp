#include "unit/app/parsed_options.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <ostream>
#include <string>
#include <vector>

namespace froxel::app {
namespace {

using testing::HasSubstr;

TEST(Options, RenderWithAll_FillsEveryField) {
    const auto command =
        parseLine(
            "render --out a.png --scene sponza.glb --animation Walk --material-variant dusk "
            "--renderer forward_plus "
            "--lights 5000 "
            "--light-radius 1.5 "
            "--light-box -10,0,-5;10,8,5 --seed 9 --light-speed 2.5 --time 2.5 --size 640x361 "
            "--camera -7,2,0;0,2,0;45 --grid 15x15x15 --grid-law hyperbolic --light-loop "
            "all_lights "
            "--shading lambert --gbuffer-normal oct10 --gbuffer-position fp16 --count-pairs "
            "--debug-view cluster_wires --debug-scale-max 12.5 --grid-camera nave --lens-shift "
            "0,0.5 "
            "--frames 20 --timings t.json --device cpu --exposure 0.5 --tone-map clamp "
            "--lighting fragment --no-scene-lights --no-animate --validation")
            .command;
    const auto& options = std::get<RenderOptions>(command);
    EXPECT_EQ(options.scene, "sponza.glb");
    EXPECT_EQ(options.choices.animation, "Walk");
    EXPECT_EQ(options.choices.material_variant, "dusk");
    EXPECT_EQ(options.settings.renderer, settings::Renderer::kForwardPlus);
    EXPECT_EQ(options.settings.lights.count, 5000U);
    EXPECT_EQ(options.settings.lights.radius_m, 1.5F);
    ASSERT_TRUE(options.settings.lights.box);
    EXPECT_EQ(options.settings.lights.box->max, glm::dvec3(10, 8, 5));
    EXPECT_EQ(options.settings.lights.seed, 9U);
    EXPECT_EQ(options.time_s, 2.5);
    EXPECT_EQ(options.settings.size, (settings::Size{640, 361}));
    EXPECT_EQ(std::get<settings::Camera>(options.camera).eye_world, glm::dvec3(-7, 2, 0));
    EXPECT_EQ(options.settings.grid,
              (settings::Grid{false, {15, 15, 15}, settings::GridLaw::kHyperbolic}));
    EXPECT_EQ(options.settings.light_loop, settings::LightLoop::kAllLights);
    EXPECT_EQ(options.settings.shading, settings::ShadingModel::kLambert);
    EXPECT_EQ(options.settings.gbuffer, (settings::GbufferLayout{settings::NormalEncoding::kOct10,
                                                                 settings::PositionSource::kFp16}));
    EXPECT_TRUE(options.settings.count_pairs);
    EXPECT_EQ(options.settings.debug.view, settings::DebugView::kClusterWires);
    EXPECT_EQ(options.settings.debug.scale_max, 12.5);
    EXPECT_EQ(options.settings.lights.speed, 2.5F);
    EXPECT_EQ(options.grid_camera, CameraChoice(std::string("nave")));
    EXPECT_EQ(options.lens_shift, glm::dvec2(0, 0.5));
    EXPECT_EQ(options.frame_count, 20U);
    EXPECT_EQ(options.timings, "t.json");
    EXPECT_EQ(options.out, "a.png");
    EXPECT_EQ(options.device.choice, gpu::DeviceChoice::kCpu);
    EXPECT_TRUE(options.device.validation);
    EXPECT_EQ(options.settings.exposure, 0.5F);
    EXPECT_EQ(options.settings.tone_map, settings::ToneMap::kClamp);
    EXPECT_EQ(options.settings.lighting, settings::LightingStage::kFragment);
    EXPECT_FALSE(options.settings.lights.scene_lights);
    EXPECT_FALSE(options.settings.lights.animate);
}

TEST(Options, RenderWithNone_KeepsTheDefaults) {
    const auto options = parseRender({});
    EXPECT_EQ(options.scene, "builtin");
    EXPECT_EQ(options.settings, settings::ViewSettings{});
    EXPECT_EQ(options.camera, CameraChoice(DefaultCamera{}));
    EXPECT_EQ(options.frame_count, 1U);
}

TEST(Options, ServeWithNone_LeavesTheViewersDefaultsToTheDevice) {
    const auto options = parse({"serve"});
    const auto& serve = std::get<ServeOptions>(options.command);
    EXPECT_EQ(serve.port, 8080);
    EXPECT_EQ(serve.address, "127.0.0.1");
    EXPECT_EQ(serve.admin, (net::BindAddress{"127.0.0.1", 9090}));
    EXPECT_FALSE(serve.agones || serve.no_depth);
    EXPECT_FALSE(serve.size || serve.quality);
    EXPECT_EQ(serve.first_view, settings::ViewSettings{});
    EXPECT_FALSE(serve.min_rate_hz);
    EXPECT_EQ(serve.resume_grace_s, 10);
    EXPECT_EQ(serve.delivery, (session::DeliverySettings{true, 0, settings::Refine::kHigh}));
    EXPECT_EQ(options.log_level, LogLevel::kInfo);
}

TEST(Options, AdminBindNone_IsNoAddress) {
    const auto options = parse({"serve", "--admin-bind", "none"});
    EXPECT_EQ(std::get<ServeOptions>(options.command).admin.address, "");
}

TEST(Options, ServeWithAll_FillsEveryField) {
    const auto options = parseLine(
        "serve --address ::1 --port 0 --admin-bind [::1]:0 --scene a.glb --animation 2 --size "
        "320x200 "
        "--quality 90 --lights 7 --light-radius 3 --adaptive off --target-fps 12.5 --refine "
        "lossless "
        "--renderer naive --lighting compute --grid 4x5x6 --light-loop lists --debug-view overdraw "
        "--light-intensity 3 --light-speed 0.5 --light-box -1,-1,-1;1,1,1 --no-animate "
        "--lens-shift -1,1 --min-fps 12.5 --resume-grace 0 --max-sessions 2 --web-root page "
        "--allow-origin https://a.example --allow-origin https://b.example "
        "--max-sessions-per-address 3 --max-sessions-per-token 4 --max-viewers-per-room 5 "
        "--paused-seconds 10 --idle-seconds 20 --forget-seconds 30 --control-idle-seconds 0 "
        "--allow-host a.example --admin-token-file operators --trusted-proxies 10.0.0.0/8,fd00::/8 "
        "--log-level debug --device gpu");
    const auto& serve = std::get<ServeOptions>(options.command);
    EXPECT_EQ(serve.address, "::1");
    EXPECT_EQ(serve.port, 0);
    EXPECT_EQ(serve.admin, (net::BindAddress{"::1", 0}));
    EXPECT_EQ(serve.scene, "a.glb");
    EXPECT_EQ(serve.choices.animation, "2");
    EXPECT_EQ(serve.size, (settings::Size{320, 200}));
    EXPECT_EQ(serve.quality, 90U);
    EXPECT_EQ(serve.first_view.lights.count, 7U);
    EXPECT_EQ(serve.first_view.lights.radius_m, 3.0F);
    EXPECT_EQ(serve.first_view.renderer, settings::Renderer::kNaive);
    EXPECT_EQ(serve.delivery,
              (session::DeliverySettings{false, 12.5, settings::Refine::kLossless}));
    EXPECT_EQ(serve.first_view.lighting, settings::LightingStage::kCompute);
    EXPECT_EQ(serve.first_view.grid, (settings::Grid{.automatic = false, .size = {4, 5, 6}}));
    EXPECT_EQ(serve.first_view.light_loop, settings::LightLoop::kLists);
    EXPECT_EQ(serve.first_view.debug.view, settings::DebugView::kOverdraw);
    EXPECT_EQ(serve.first_view.lights.intensity, 3.0F);
    EXPECT_EQ(serve.first_view.lights.speed, 0.5F);
    EXPECT_EQ(serve.first_view.lights.box, (BoundsD3{{-1, -1, -1}, {1, 1, 1}}));
    EXPECT_FALSE(serve.first_view.lights.animate);
    EXPECT_EQ(serve.lens_shift, glm::dvec2(-1, 1));
    EXPECT_EQ(serve.sessions_max, 2U);
    EXPECT_EQ(serve.min_rate_hz, 12.5);
    EXPECT_EQ(serve.resume_grace_s, 0);
    EXPECT_EQ(serve.web_root, "page");
    EXPECT_THAT(serve.allowed_origins,
                testing::ElementsAre("https://a.example", "https://b.example"));
    EXPECT_EQ(serve.sessions_per_address, 3U);
    EXPECT_EQ(serve.sessions_per_token, 4U);
    EXPECT_EQ(serve.viewers_per_room, 5U);
    EXPECT_EQ(serve.paused_s, 10);
    EXPECT_EQ(serve.idle_s, 20);
    EXPECT_EQ(serve.forget_s, 30);
    EXPECT_EQ(serve.control_idle_s, 0);
    EXPECT_THAT(serve.host_names, testing::ElementsAre("a.example"));
    EXPECT_EQ(serve.admin_token_file, "operators");
    EXPECT_THAT(serve.trusted_proxies, testing::ElementsAre("10.0.0.0/8", "fd00::/8"));
    EXPECT_EQ(serve.device, gpu::DeviceChoice::kGpu);
    EXPECT_EQ(options.log_level, LogLevel::kDebug);
}

TEST(Options, Bench_FillsEveryField) {
    const auto options = parse({"bench",
                                "--preset",
                                "grid",
                                "--preset",
                                "smoke",
                                "--scene",
                                "a.glb",
                                "--camera",
                                "-7,2,0;0,2,0;45",
                                "--camera",
                                "Nave",
                                "--size",
                                "320x200",
                                "--lights",
                                "70",
                                "--seconds-per-row",
                                "2.5",
                                "--error-size",
                                "64x36",
                                "--r1-pairs",
                                "1e6",
                                "--r2-pairs",
                                "0",
                                "--out",
                                "a.json",
                                "--report",
                                "a.html"});
    const auto& bench = std::get<BenchOptions>(options.command);
    EXPECT_THAT(bench.presets, testing::ElementsAre("grid", "smoke"));
    EXPECT_EQ(bench.scene, "a.glb");
    EXPECT_THAT(bench.cameras, testing::ElementsAre("-7,2,0;0,2,0;45", "Nave"));
    EXPECT_EQ(bench.settings.size, (settings::Size{320, 200}));
    EXPECT_EQ(bench.settings.lights.count, 70U);
    EXPECT_EQ(bench.seconds_per_row, 2.5);
    EXPECT_EQ(bench.error_size, (settings::Size{64, 36}));
    EXPECT_EQ(bench.r1_pairs_limit, 1e6);
    EXPECT_EQ(bench.r2_pairs_limit, 0.0);
    EXPECT_EQ(bench.out, "a.json");
    EXPECT_EQ(bench.report, "a.html");
    EXPECT_FALSE(bench.list);
    const auto compared = parse({"bench", "--compare", "a.json", "b.json"});
    EXPECT_THAT(std::get<BenchOptions>(compared.command).compare,
                testing::ElementsAre("a.json", "b.json"));
}

TEST(Options, InfoAndScene_AreParsed) {
    const auto info = std::get<InfoOptions>(parse({"info", "--json", "--scene", "a.glb"}).command);
    EXPECT_TRUE(info.json);
    EXPECT_EQ(info.scene, "a.glb");
    const auto scene = std::get<SceneOptions>(parse({"scene", "--out", "hall.glb"}).command);
    EXPECT_EQ(scene.out, "hall.glb");
}

TEST(Options, Help_IsTextWithUnitsRangesAndDefaults) {
    const auto text = std::get<PrintText>(parse({"render", "--help"}).command).text;
    for (const char* part :
         {"--light-radius N ", "0.001 to 10000 m [2]", "auto|XxYxZ", "[auto]", "16x16 to 4096x4096",
          "[1]", "naive, forward_plus", "Exit codes: 0 success, 1 other error, 2 usage"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    EXPECT_THAT(std::get<PrintText>(parse({"--help"}).command).text, HasSubstr("serve"));
    EXPECT_THAT(std::get<PrintText>(parse({"--help-all"}).command).text, HasSubstr("--web-root"));
}

TEST(Options, Version_IsText) {
    EXPECT_THAT(std::get<PrintText>(parse({"--version"}).command).text,
                testing::MatchesRegex("froxel [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

struct Refusal {
    std::vector<const char*> arguments;
    std::vector<const char*> message; // parts
};

void PrintTo(const Refusal& refusal, std::ostream* stream) {
    for (const char* argument : refusal.arguments) {
        *stream << argument << ' ';
    }
}

class BadCommandLine : public testing::TestWithParam<Refusal> {};

TEST_P(BadCommandLine, Parsed_RefusedInOneLine) {
    const std::string message = refusal(GetParam().arguments);
    for (const char* part : GetParam().message) {
        EXPECT_THAT(message, HasSubstr(part));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Options,
    BadCommandLine,
    testing::Values(
        Refusal{{},
                {"serve, render, record, bench, load, info, diff, scene, bake or probe",
                 "froxel --help"}},
        Refusal{{"draw"}, {"froxel has no command draw (see froxel --help)"}},
        Refusal{{"srve"}, {"froxel has no command srve; did you mean serve?"}},
        Refusal{{"--vresion"}, {"froxel has no option --vresion; did you mean --version?"}},
        Refusal{{"serve", "--prot", "1"},
                {"froxel serve has no option --prot; did you mean --port? (see froxel serve"}},
        Refusal{{"serve", "--lihgts=7"}, {"no option --lihgts; did you mean --lights?"}},
        Refusal{{"serve", "--nothing-like-it"}, {"no option --nothing-like-it (see"}},
        Refusal{{"render"}, {"--out FILE", "--timings FILE"}},
        Refusal{{"render", "--out", "a.png", "--lights", "1000001"},
                {"--lights", "'1000001'", "from 0 to 1000000", "froxel render --help"}},
        Refusal{{"render", "--out", "a.png", "--lights", "7x"}, {"--lights", "'7x'"}},
        Refusal{{"render", "--out", "a.png", "--light-radius", "nan"},
                {"--light-radius", "'nan'", "0.001 to 10000"}},
        Refusal{{"render", "--out", "a.png", "--renderer", "deferred"},
                {"--renderer", "'deferred'", "clustered_deferred"}},
        Refusal{{"render", "--out", "a.png", "--size", "0x0"}, {"--size", "'0x0'", "16x16"}},
        Refusal{{"render", "--out", "a.png", "--camera", "1,2;3"}, {"--camera", "'1,2;3'"}},
        Refusal{{"render", "--out", "a.gif"}, {"--out", "a.gif", ".png"}},
        Refusal{{"render", "--out", "a.png", "--quality", "50"}, {"--quality", "a.png", ".jpg"}},
        Refusal{{"render", "--out", "a.png", "--lights"}, {"--lights"}},
        Refusal{{"render", "--out", "a.png", "--seed", "1", "--seed", "2"}, {"--seed"}},
        Refusal{{"render", "--out", "a.png", "--sed", "1"}, {"--sed"}},
        Refusal{{"render", "--out", "a.png", "stray"}, {"unexpected argument 'stray'"}},
        Refusal{{"serve", "--port", "65536"}, {"--port", "'65536'", "0 to 65535"}},
        Refusal{{"serve", "--admin-bind", "9090"}, {"--admin-bind", "'9090'", "127.0.0.1:9090"}},
        Refusal{{"serve", "--admin-bind", ":9090"}, {"--admin-bind", "':9090'"}},
        Refusal{{"serve", "--admin-bind", "::1:9090"}, {"--admin-bind", "'::1:9090'"}},
        Refusal{{"serve", "--admin-bind", "127.0.0.1:65536"}, {"--admin-bind", ":65536'"}},
        Refusal{{"serve", "--resume-grace", "3601"}, {"--resume-grace", "'3601'", "0 to 3600"}},
        Refusal{{"serve", "--min-fps", "nan"}, {"--min-fps", "'nan'", "0 to 1000"}},
        Refusal{{"load", "ws://a/ws", "--room", "a b"}, {"--room", "'a b'", "1 to 64"}},
        Refusal{{"serve", "--adaptive", "yes"}, {"--adaptive", "'yes'", "off or on"}},
        Refusal{{"serve", "--target-fps", "-1"}, {"--target-fps", "0 to 240"}},
        Refusal{{"serve", "--refine", "best"}, {"--refine", "none, high or lossless"}},
        Refusal{{"serve", "--log-level", "loud"}, {"--log-level", "'loud'", "debug, info"}},
        Refusal{{"load"}, {"URL", "froxel load --help"}},
        Refusal{{"load", "localhost:8080"}, {"'localhost:8080'", "ws://127.0.0.1:8080/ws"}},
        Refusal{{"load", "ws://a", "--viewers", "0"}, {"--viewers", "'0'", "1 to 10000"}},
        Refusal{{"load", "ws://a", "--script", "dance"},
                {"--script", "'dance'", "orbit", ".jsonl"}},
        Refusal{{"load", "ws://a", "--require", "fps>=nan"}, {"--require", "'fps>=nan'", "'nan'"}},
        Refusal{{"load", "ws://a", "--stages", "1x:2"}, {"--stages", "'1x:2'", "1m:10"}},
        Refusal{{"load", "ws://a", "--stages", "1s:2", "--viewers", "2"},
                {"--stages", "--viewers"}},
        Refusal{{"load", "ws://a", "--find", "fps>=3", "--require", "fps>=3"},
                {"--find", "--require"}},
        Refusal{{"load", "ws://a", "--think", "3-1"}, {"--think", "'3-1'", "1-5"}},
        Refusal{{"load", "ws://a", "--series", "a.txt"}, {"--series", "'a.txt'", ".csv"}},
        Refusal{{"load", "ws://a", "--script", "orbit:0"}, {"--script", "'orbit:0'", ":SHARE"}},
        Refusal{{"scene"}, {"--out"}},
        Refusal{{"scene", "--out", "hall.obj"}, {"--out", "'hall.obj'", ".glb"}}));

} // namespace
} // namespace froxel::app
