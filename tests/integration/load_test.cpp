// `froxel load` from outside: what it measures, how it ends, what it says.
#include "integration/server_process.h"
#include "integration/test_server.h"
#include "relay/relay.h"
#include "support/places.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

std::string urlOf(uint16_t port) {
    return "ws://127.0.0.1:" + std::to_string(port) + "/ws";
}

ChildProcess startLoad(uint16_t port, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {test::binaryPath(), "load", urlOf(port)});
    return ChildProcess(std::move(arguments));
}

ChildProcess::End load(uint16_t port, std::vector<std::string> arguments) {
    return startLoad(port, std::move(arguments)).wait();
}

class Load : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = testing::TempDir() + "froxel_load_XXXXXX";
        ASSERT_NE(mkdtemp(folder_.data()), nullptr);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    // The report of a run that must end well.
    Json measure(uint16_t port, std::vector<std::string> arguments) {
        const std::string file = folder_ + "/load.json";
        arguments.insert(arguments.end(), {"--json", file});
        const auto end = load(port, std::move(arguments));
        EXPECT_EQ(end.exit_code, 0) << end.errors;
        EXPECT_EQ(end.errors, "");
        EXPECT_NE(end.output.find("viewers: "), std::string::npos) << end.output;
        std::ifstream stream(file);
        Json report = Json::parse(stream);
        EXPECT_EQ(report["schema"], "froxel.load.v2");
        EXPECT_EQ(report["broken"], nullptr);
        return report;
    }

    std::string write(const std::string& text) const {
        const std::string file = folder_ + "/script.jsonl";
        std::ofstream(file) << text;
        return file;
    }

    std::string folder_;
};

TEST_F(Load, JsonToStandardOutput_IsAllThatIsThere) {
    const TestServer server;
    const auto end =
        load(server.port(), {"--viewers", "1", "--seconds", "1", "--ramp", "0", "--json", "-"});
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_EQ(Json::parse(end.output)["schema"], "froxel.load.v2");
    EXPECT_NE(end.errors.find("viewers: "), std::string::npos) << end.errors;
}

TEST_F(Load, ThreeViewers_Orbit_GetFramesAndLatencies) {
    const TestServer server;
    const Json report =
        measure(server.port(), {"--viewers", "3", "--seconds", "1", "--ramp", "0.2"});
    ASSERT_EQ(report["each"].size(), 3U);
    uint64_t frames = 0;
    for (const Json& viewer : report["each"]) {
        EXPECT_EQ(viewer["failure"], nullptr);
        EXPECT_GT(viewer["first_frame_ms"], 0);
        EXPECT_GT(viewer["frames"], 0);
        EXPECT_GT(viewer["commands"], 10);
        EXPECT_GT(viewer["latency_ms"]["median"], 0);
        EXPECT_LT(viewer["latency_ms"]["p99"], 1000);
        EXPECT_GE(viewer["reaction_ms"]["count"], viewer["latency_ms"]["count"]);
        EXPECT_EQ(viewer["age_ms"]["count"], viewer["frames"]);
        EXPECT_EQ(viewer["interval_ms"]["count"], viewer["frames"].get<uint64_t>() + 1)
            << "to the end, too";
        EXPECT_LE(viewer["age_ms"]["median"], viewer["latency_ms"]["median"]);
        EXPECT_GE(viewer["received_bytes"], viewer["frame_bytes"]);
        EXPECT_EQ(viewer["errors"], 0);
        frames += viewer["frames"].get<uint64_t>();
    }
    EXPECT_EQ(report["all"]["frames"], frames);
    EXPECT_GT(report["all"]["stages_ms"]["render"]["count"], 0);
    ASSERT_EQ(report["served"].size(), 1U);
    EXPECT_EQ(report["served"][0]["viewers"], 3);
    EXPECT_EQ(report["served"][0]["scene"], "fake");
    EXPECT_EQ(report["served"][0]["lights"], 100);
    EXPECT_EQ(report["all"]["largest_picture"]["width_px"], 64);
}

TEST_F(Load, Depth_ComesToThoseWhoAskForIt) {
    const TestServer server;
    const auto one = [this, &server](std::vector<std::string> options) {
        options.insert(options.end(), {"--viewers", "1", "--seconds", "1", "--ramp", "0"});
        return measure(server.port(), options)["each"][0];
    };
    const Json with = one({"--depth"});
    EXPECT_EQ(with["failure"], nullptr);
    EXPECT_GT(with["depth_meshes"], 1) << "of a camera that circles";
    EXPECT_LE(with["depth_meshes"], with["frames"].get<uint64_t>() + 1);
    EXPECT_GT(with["depth_bytes"], with["depth_meshes"]);
    EXPECT_GT(with["latency_ms"]["median"], 0);
    const Json without = one({});
    EXPECT_EQ(without["depth_meshes"], 0);
    EXPECT_GT(without["frames"], 0);
}

TEST_F(Load, Server_ThatFreezes_BreaksTheLatencyBound) {
    TestServer server;
    const Relay relay({.port = server.port()});
    auto run = startLoad(relay.port(), {"--seconds", "4", "--require", "stall<1000"});
    ASSERT_TRUE(relay.waitForDown(20'000, 20s)) << "pictures flow";
    server.device().setGate(false);
    const auto end = run.wait(20s);
    server.device().setGate(true);
    EXPECT_EQ(end.exit_code, 99);
    EXPECT_NE(end.errors.find("broken requirement stall<1000: "), std::string::npos) << end.errors;
}

TEST_F(Load, Room_FirstControls_OthersWatchTheSame) {
    TestServer server;
    const Json report =
        measure(server.port(), {"--viewers", "4", "--seconds", "1", "--room", "hall", "--size",
                                "100x60", "--require", "latency.p95.max<5000, stall<5000"});
    EXPECT_EQ(report["room"], "hall");
    EXPECT_EQ(server.device().made_views, 1);
    int talking = 0;
    for (const Json& viewer : report["each"]) {
        EXPECT_EQ(viewer["errors"], 0);
        EXPECT_GT(viewer["frames"], 0);
        EXPECT_EQ(viewer["age_ms"]["count"], viewer["frames"]) << "of who watches, too";
        talking += viewer["commands"] > 0;
        EXPECT_EQ(viewer["latency_ms"] == nullptr, viewer["commands"] == 0);
    }
    EXPECT_EQ(talking, 1);
}

TEST_F(Load, Idle_NothingMoves_NoFrameAndFewBytes) {
    TestServer server({.still = true});
    const Json report = measure(server.port(), {"--script", "idle", "--seconds", "2"});
    EXPECT_EQ(report["all"]["frames"], 0);
    EXPECT_LT(report["all"]["received_bytes_per_s"], 200);
    EXPECT_EQ(report["all"]["commands"], 0);
    EXPECT_EQ(report["all"]["interval_ms"], nullptr) << "no frame was due";
}

// What it asks for may be too much, and never wrong.
TEST_F(Load, Storm_IsRefusedForWhatItCostsAlone) {
    const TestServer server;
    const Json report = measure(server.port(), {"--script", "storm", "--seconds", "2"});
    EXPECT_GT(report["all"]["commands"], 100);
    EXPECT_GT(report["all"]["latency_ms"]["count"], 0);
    for (const auto& [code, count] : report["all"]["errors_by_code"].items()) {
        EXPECT_EQ(code, "ERROR_CODE_CAPACITY") << report["all"]["first_error"];
    }
}

// The viewers check that each frame of video can be decoded.
TEST_F(Load, Video_OfSeveralViewers_BeginsWithAKeyFrameAndGoesOn) {
    const TestServer server;
    const Json report = measure(server.port(), {"--viewers", "2", "--seconds", "1", "--codec",
                                                "vp9", "--video-kbps", "500"});
    EXPECT_EQ(report["codec"], "vp9");
    for (const Json& viewer : report["each"]) {
        EXPECT_EQ(viewer["failure"], nullptr);
        EXPECT_EQ(viewer["errors"], 0);
        EXPECT_GT(viewer["frames"], 10);
        EXPECT_EQ(viewer["key_frames"], 1);
    }
}

TEST_F(Load, Script_FromAFile_IsPlayed) {
    const TestServer server({.still = true});
    const std::string file = write(R"({"setSize": {"width": 100, "height": 50}}
{"at_ms": 300, "setExposure": {"exposure": 2}}
)");
    const Json report = measure(server.port(), {"--script", file, "--seconds", "1"});
    EXPECT_EQ(report["all"]["commands"], 2);
    EXPECT_EQ(report["all"]["latency_ms"]["count"], 2);
    EXPECT_EQ(report["all"]["interval_ms"]["count"], 2);
    EXPECT_LT(report["all"]["interval_ms"]["max"], 300) << "nothing was due between them";
    EXPECT_EQ(report["all"]["commands_unshown"], 0);
    EXPECT_EQ(report["scripts"][0]["name"], "script.jsonl");
}

// client-web/test/protocol/recorder.test.ts holds the page to this very file.
TEST_F(Load, Script_RecordedByThePage_IsPlayedWhole) {
    const TestServer server({.still = true});
    const Json report =
        measure(server.port(),
                {"--script", test::repositoryPath("tests/load/recorded.jsonl"), "--seconds", "2"});
    EXPECT_EQ(report["all"]["commands"], 12);
    EXPECT_EQ(report["all"]["errors"], 0) << report["all"]["first_error"];
}

TEST_F(Load, Script_Bad_IsRefusedBeforeConnecting) {
    const std::string file = write("{\"ping\": {}}\n{\"setSise\": {}}\n");
    const auto end = load(1, {"--script", file});
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_EQ(end.output, "");
    EXPECT_NE(end.errors.find(file + ":2: "), std::string::npos) << end.errors;
    EXPECT_NE(end.errors.find("setSise"), std::string::npos) << end.errors;
    EXPECT_EQ(std::count(end.errors.begin(), end.errors.end(), '\n'), 1) << end.errors;
}

TEST_F(Load, Requirements_BrokenByASlowServer_ExitWith99AndAreNamed) {
    TestServer server;
    server.device().frame_time = 100ms;
    const std::string junit = folder_ + "/junit.xml";
    const std::string histograms = folder_ + "/load.hlog";
    const auto end = load(server.port(), {"--seconds", "1", "--viewers", "2", "--require",
                                          "fps>=30, latency.p50<60000", "--require", "errors<=0",
                                          "--junit", junit, "--histograms", histograms});
    EXPECT_EQ(end.exit_code, 99);
    EXPECT_NE(end.errors.find("broken requirement fps>=30: "), std::string::npos) << end.errors;
    EXPECT_EQ(std::count(end.errors.begin(), end.errors.end(), '\n'), 1) << end.errors;
    EXPECT_NE(end.output.find("held    latency.p50<60000: "), std::string::npos) << end.output;
    EXPECT_NE(end.output.find("broken  fps>=30: "), std::string::npos) << end.output;
    std::ifstream stream(junit);
    const std::string xml{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(xml.find(R"(tests="4" failures="1")"), std::string::npos) << xml;
    std::ifstream log(histograms);
    const std::string tags{std::istreambuf_iterator<char>(log), {}};
    EXPECT_NE(tags.find("\nTag=latency,0.000,"), std::string::npos) << tags;
    EXPECT_NE(tags.find("\nTag=render,0.000,"), std::string::npos) << tags;
}

TEST_F(Load, StopEarly_WithASlowServer_EndsLongBeforeTheTime) {
    TestServer server;
    server.device().frame_time = 100ms;
    auto run = startLoad(server.port(),
                         {"--seconds", "3600", "--require", "fps>=1000", "--stop-early", "1"});
    const auto end = run.wait(60s);
    EXPECT_EQ(end.exit_code, 99) << end.errors;
    EXPECT_NE(end.output.find("(ended early)"), std::string::npos) << end.output;
}

TEST_F(Load, Stages_LetViewersComeAndGo_AndTheSeriesShowsIt) {
    const TestServer server;
    const std::string series = folder_ + "/series.jsonl";
    const Json report =
        measure(server.port(), {"--stages", "0s:1,2s:1,0s:4,4s:4,0s:0,1s:0", "--script", "orbit:3",
                                "--script", "idle:1", "--series", series});
    EXPECT_EQ(report["viewers"], 4);
    EXPECT_EQ(report["stages"][1]["seconds"], 2);
    std::vector<int> counts;
    std::ifstream stream(series);
    for (std::string line; std::getline(stream, line);) {
        counts.push_back(Json::parse(line)["viewers"]);
    }
    ASSERT_EQ(counts.size(), report["series"].size());
    ASSERT_GE(counts.size(), 4U);
    EXPECT_LE(counts.front(), 1);
    EXPECT_EQ(*std::max_element(counts.begin(), counts.end()), 4);
    EXPECT_EQ(counts.back(), 0);
    int talking = 0;
    for (const Json& viewer : report["each"]) {
        EXPECT_EQ(viewer["failure"], nullptr);
        EXPECT_GT(viewer["frames"], 0);
        talking += viewer["commands"] > 0 ? 1 : 0;
    }
    EXPECT_EQ(talking, 3);
}

// The device takes 20 ms for each picture, and all share it: 25 viewers would have 2 a second.
TEST_F(Load, Find_OnASlowServer_FindsHowManyItCarries) {
    TestServer server({.sessions_max = 100});
    server.device().frame_time = 20ms;
    const std::string file = folder_ + "/capacity.json";
    const auto end = load(server.port(), {"--find", "fps>=8", "--seconds", "1", "--trials", "1",
                                          "--viewers", "40", "--json", file});
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_NE(end.output.find("capacity: "), std::string::npos) << end.output;
    std::ifstream stream(file);
    const Json report = Json::parse(stream);
    EXPECT_EQ(report["schema"], "froxel.capacity.v1");
    EXPECT_GE(report["capacity"], 1);
    EXPECT_LE(report["capacity"], 6) << "50 pictures a second are 6 viewers with 8 each";
    EXPECT_GT(report["broken_from"], report["capacity"]);
    EXPECT_EQ(report["served"][0]["scene"], "fake");
}

TEST_F(Load, Find_RefusedViewer_IsAnAnswer) {
    const TestServer server({.sessions_max = 3});
    const auto end = load(server.port(), {"--find", "errors<=0", "--seconds", "0.5"});
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_NE(end.output.find("capacity: 3 viewers (held in 3 of 3 trials with 3 viewers, held in "
                              "0 of 3 trials with 4 viewers)"),
              std::string::npos)
        << end.output;
}

TEST_F(Load, Find_WithoutAServer_ExitsOne) {
    const auto end = load(1, {"--find", "errors<=0", "--trials", "1"});
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_NE(end.errors.find("not even one viewer is served as required: 1 of 1 viewers failed"),
              std::string::npos)
        << end.errors;
}

TEST_F(Load, RefusedViewers_WithinTheShareAllowed_AreNoFailure) {
    const TestServer server({.sessions_max = 2});
    const Json report =
        measure(server.port(), {"--seconds", "0.5", "--viewers", "3", "--require", "refused<=40%"});
    EXPECT_NEAR(report["requirements"][0]["measured"].get<double>(), 1.0 / 3, 1e-9);
    EXPECT_EQ(report["each"][0]["refused"].get<int>() + report["each"][1]["refused"].get<int>() +
                  report["each"][2]["refused"].get<int>(),
              1);
}

TEST_F(Load, Server_Full_IsNamedAndTheOthersAreMeasured) {
    const TestServer server({.sessions_max = 2});
    const auto end = load(server.port(), {"--seconds", "0.5", "--viewers", "3"});
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_NE(end.errors.find("1 of 3 viewers failed: viewer "), std::string::npos) << end.errors;
    EXPECT_NE(end.output.find("viewers: 2 of 3"), std::string::npos) << end.output;
}

TEST_F(Load, Server_Absent_ExitsOneInOneLine) {
    const auto end = load(1, {"--viewers", "3"});
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_EQ(end.output, "");
    EXPECT_NE(end.errors.find("cannot connect to 127.0.0.1:1"), std::string::npos) << end.errors;
    EXPECT_EQ(std::count(end.errors.begin(), end.errors.end(), '\n'), 1) << end.errors;
}

TEST_F(Load, Server_Killed_ExitsOneInOneLine) {
    ServerProcess server({"--size", "160x90", "--lights", "50"});
    const Relay relay({.port = server.port().value()});
    auto run = startLoad(relay.port(), {"--seconds", "60", "--viewers", "3"});
    ASSERT_TRUE(relay.waitForDown(100'000, 60s)) << "pictures flow";
    server.signal(SIGKILL);
    const auto end = run.wait(10s);
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_NE(end.errors.find("3 of 3 viewers failed: viewer 1: the connection broke"),
              std::string::npos)
        << end.errors;
    EXPECT_EQ(std::count(end.errors.begin(), end.errors.end(), '\n'), 1) << end.errors;
}

TEST_F(Load, Interrupted_SaysWhatItMeasured) {
    const TestServer server;
    const Relay relay({.port = server.port()});
    auto run = startLoad(relay.port(), {"--seconds", "60"});
    ASSERT_TRUE(relay.waitForDown(100'000, 20s));
    run.signal(SIGINT);
    const auto end = run.wait(10s);
    EXPECT_EQ(end.exit_code, 130) << end.errors;
    EXPECT_NE(end.output.find("(stopped)"), std::string::npos) << end.output;
}

// A server that filled what TCP lets it fill would show pictures many seconds old here.
TEST_F(Load, SlowLink_FrameAgeStaysBounded) {
    const TestServer server({.size = {1280, 720}});
    RelayOptions options{.port = server.port()};
    options.down = {100'000, 10ms, 32 * 1024};
    options.up.delay = 10ms;
    const Relay relay(options);
    const Json all = measure(relay.port(), {"--seconds", "5"})["all"];
    const double rate = all["received_bytes_per_s"].get<double>();
    EXPECT_LT(rate, 110'000);
    EXPECT_GT(rate, 50'000) << "the link is not made use of";
    RecordProperty("age_p99_ms", static_cast<int>(all["age_ms"]["p99"].get<double>()));
    // The median is some 100 ms, the oldest of some 40 pictures 420 to 450 ms, more on a busy
    // machine; what TCP would let it fill is 40 s of this link. Finer bounds, on a clock of its
    // own, are adaptation_test's.
    EXPECT_LT(all["age_ms"]["median"].get<double>(), 1000) << all.dump(1);
    EXPECT_LT(all["age_ms"]["max"].get<double>(), 4000) << all.dump(1);
}

} // namespace
} // namespace froxel::test
