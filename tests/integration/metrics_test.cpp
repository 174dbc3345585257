// The admin address, and what a scrape of it says.
#include "integration/eventually.h"
#include "integration/http_exchange.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace froxel::test {
namespace {

// What a shell command prints, and its exit code.
std::pair<std::string, int> shell(const std::string& command) {
    const auto close = [](FILE* pipe) { return pclose(pipe); };
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    std::string output;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) {
        output += static_cast<char>(c);
    }
    return {output, WEXITSTATUS(close(pipe))};
}

std::string scrape(const TestServer& server) {
    const std::string answer = httpGet(server.adminPort(), "/metrics");
    EXPECT_EQ(statusOf(answer), 200);
    EXPECT_NE(answer.find("Content-Type: text/plain; version=0.0.4"), std::string::npos);
    return bodyOf(answer);
}

TEST(Admin, Scrape_WithAViewer_Counts) {
    TestServer server;
    WsClient viewer(server.port());
    viewer.join();
    viewer.expectFrame();
    viewer.expectFrame();
    const std::string text = scrape(server);
    EXPECT_EQ(sampleOf(text, "froxel_sessions"), 1);
    EXPECT_EQ(sampleOf(text, "froxel_viewers"), 1);
    EXPECT_GE(sampleOf(text, "froxel_frames_sent_total"), 2);
    EXPECT_GT(sampleOf(text, "froxel_sent_bytes_total"), 100);
    EXPECT_EQ(sampleOf(text, "froxel_light_list_p95_entries"), 9);
    EXPECT_EQ(sampleOf(text, "froxel_device_memory_bytes{purpose=\"pixels\"}"), 4096);
    for (const char* stage : {"render", "gpu", "encode_wait", "encode", "send_wait"}) {
        const std::string label = std::string("{stage=\"") + stage;
        EXPECT_GE(sampleOf(text, "froxel_stage_duration_seconds_count" + label + "\"}"), 2);
    }
}

// What is compared with the capacity: a room takes one place, and a lost viewer keeps its own.
TEST(Admin, Scrape_SessionsAreThePlacesTaken) {
    TestServer server({.sessions_max = 3, .resume_grace = std::chrono::seconds(60)});
    WsClient first(server.port());
    WsClient second(server.port());
    WsClient lost(server.port());
    first.join("hall");
    second.join("hall");
    lost.join();
    lost.abort();
    EXPECT_TRUE(eventually([&] { return sampleOf(scrape(server), "froxel_viewers") == 2; }));
    const std::string text = scrape(server);
    EXPECT_EQ(sampleOf(text, "froxel_sessions"), 2);
    EXPECT_EQ(sampleOf(text, "froxel_session_capacity"), 3);
    EXPECT_EQ(sampleOf(text, "froxel_viewers_joined_total"), 3);
}

// Prometheus' own judgement of names, types, help texts and format.
TEST(Admin, Scrape_WithAViewer_PromtoolAccepts) {
    if (shell("command -v promtool").second != 0) {
        GTEST_SKIP() << "promtool is not here (Debian: prometheus)";
    }
    TestServer server;
    WsClient viewer(server.port());
    viewer.join();
    viewer.expectFrame();
    const auto file = std::filesystem::path(testing::TempDir()) /
                      ("froxel_scrape_" + std::to_string(getpid()) + ".txt");
    std::ofstream(file) << scrape(server);
    const auto [said, code] = shell("promtool check metrics < " + file.string());
    std::filesystem::remove(file);
    EXPECT_EQ(code, 0) << said;
    EXPECT_EQ(said, "");
}

TEST(Admin, ManyConnections_AreBoundedAndTheNextScrapeAnswers) {
    TestServer server;
    boost::asio::io_context io;
    {
        std::vector<boost::asio::ip::tcp::socket> held;
        for (int i = 0; i < 100; ++i) {
            held.emplace_back(io).connect(
                {boost::asio::ip::address_v4::loopback(), server.adminPort()});
        }
        WsClient(server.port()).join(); // viewers do not notice
    }
    const auto end = Clock::now() + std::chrono::seconds(20); // until the server has seen them go
    while (statusOf(httpGet(server.adminPort(), "/metrics")) != 200) {
        ASSERT_LT(Clock::now(), end);
    }
}

TEST(Admin, Drain_ScrapesAreAnsweredToTheEnd) {
    TestServer server;
    WsClient viewer(server.port());
    viewer.join();
    EXPECT_FALSE(server.run().drain(std::chrono::milliseconds(50))); // it does not answer
    EXPECT_NE(scrape(server), "");
}

} // namespace
} // namespace froxel::test
