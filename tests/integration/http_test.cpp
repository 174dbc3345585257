// Plain HTTP: the page from memory, health, and everything that is not asked for politely.
#include "integration/http_exchange.h"
#include "integration/raw_web_socket.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <gmock/gmock.h>
#include <string>
#include <tuple>
#include <unistd.h>

namespace froxel::test {
namespace {

using testing::TempDir;

class HttpTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        const std::filesystem::path root = webRoot();
        std::filesystem::create_directories(root / "assets");
        std::ofstream(root / "index.html") << "<!doctype html><title>page</title>";
        std::ofstream(root / "assets" / "main-1a2b.js") << "export {};";
        std::ofstream(root / "assets" / "main-1a2b.js.gz") << "as gzip has it";
        std::ofstream(root.parent_path() / "secret.txt") << "secret";
        std::error_code ignored;
        std::filesystem::create_symlink("../secret.txt", root / "link.txt", ignored);
    }
    static std::filesystem::path webRoot() {
        // Tests of this suite run in processes of their own, side by side.
        return std::filesystem::path(TempDir()) / ("froxel_http_test_" + std::to_string(getpid())) /
               "web";
    }

    std::string exchange(const std::string& raw) { return httpExchange(server_.port(), raw); }
    std::string get(const std::string& target, const std::string& headers = {}) {
        return httpGet(server_.port(), target, headers);
    }

    TestServer server_{{.web_root = webRoot()}};
};

TEST_F(HttpTest, Page_RootWithAQuery_IsServedWithItsHeaders) {
    const std::string answer = get("/?renderer=naive");
    EXPECT_EQ(statusOf(answer), 200);
    for (const char* expected :
         {"Content-Type: text/html; charset=utf-8", "X-Content-Type-Options: nosniff",
          "frame-ancestors 'none'", "Cache-Control: no-cache", "ETag: \"", "<title>page</title>"}) {
        EXPECT_NE(answer.find(expected), std::string::npos) << expected << "\n" << answer;
    }
}

TEST_F(HttpTest, Asset_IsSentAsTheClientUnderstandsIt) {
    const std::string coded = get("/assets/main-1a2b.js", "Accept-Encoding: gzip, deflate, br\r\n");
    for (const char* expected : {"Content-Encoding: gzip", "Vary: Accept-Encoding",
                                 "text/javascript", "immutable", "as gzip has it"}) {
        EXPECT_NE(coded.find(expected), std::string::npos) << expected << "\n" << coded;
    }
    const std::string plain = get("/assets/main-1a2b.js");
    EXPECT_NE(plain.find("export {};"), std::string::npos);
    EXPECT_NE(plain.find("Vary: Accept-Encoding"), std::string::npos);
    EXPECT_EQ(plain.find("Content-Encoding"), std::string::npos);
    // In two lines, and with the tag of this very coding.
    const size_t tag = coded.find("ETag: ") + 6;
    const std::string etag = coded.substr(tag, coded.find('\r', tag) - tag);
    EXPECT_EQ(
        statusOf(get("/assets/main-1a2b.js", "Accept-Encoding: br\r\nAccept-Encoding: gzip\r\n"
                                             "If-None-Match: " +
                                                 etag + "\r\n")),
        304);
    EXPECT_EQ(statusOf(get("/assets/main-1a2b.js", "If-None-Match: " + etag + "\r\n")), 200);
    EXPECT_EQ(statusOf(get("/assets/main-1a2b.js.gz")), 404);
}

TEST_F(HttpTest, Still_IsAPictureWithATag) {
    const std::string answer = httpGetOnceThere(server_.port(), "/render?size=64x48&lights=3");
    EXPECT_EQ(statusOf(answer), 200) << answer.substr(0, 400);
    EXPECT_NE(answer.find("Content-Type: image/jpeg"), std::string::npos);
    EXPECT_EQ(bodyOf(answer).substr(0, 2), "\xFF\xD8");
    EXPECT_EQ(bodyOf(get("/render?size=64x48&format=png")).substr(1, 3), "PNG");
    EXPECT_EQ(bodyOf(get("/render?size=64x48&format=exr")).substr(0, 4), "\x76\x2F\x31\x01");
    const size_t tag = answer.find("ETag: ") + 6;
    const std::string known =
        "If-None-Match: " + answer.substr(tag, answer.find('\r', tag) - tag) + "\r\n";
    EXPECT_EQ(statusOf(get("/render?lights=3&size=64x48", known)), 304) << "in any order";
    EXPECT_EQ(statusOf(get("/render?lights=4&size=64x48", known)), 200);
    const std::string head = exchange("HEAD /render?size=64x48&lights=3 HTTP/1.1\r\n"
                                      "Host: localhost\r\nConnection: close\r\n\r\n");
    EXPECT_EQ(statusOf(head), 200);
    EXPECT_EQ(bodyOf(head), "");
}

TEST_F(HttpTest, Still_OfSeveralViews_IsASheet) {
    const std::string query = "/render?size=64x48&views=front,top,iso";
    const std::string answer = httpGetOnceThere(server_.port(), query);
    ASSERT_EQ(statusOf(answer), 200) << answer.substr(0, 400);
    EXPECT_EQ(bodyOf(answer).substr(0, 2), "\xFF\xD8");
    const std::string png = bodyOf(get(query + "&format=png"));
    ASSERT_EQ(png.substr(1, 3), "PNG");
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x80\0\0\0\x60", 8)) << "128x96";
    const size_t tag = answer.find("ETag: ") + 6;
    const std::string known =
        "If-None-Match: " + answer.substr(tag, answer.find('\r', tag) - tag) + "\r\n";
    EXPECT_EQ(statusOf(get(query, known)), 304);
    EXPECT_EQ(statusOf(get("/render?size=64x48&views=top,front,iso", known)), 200);
    EXPECT_EQ(statusOf(get("/render?size=64x48&views=front,top,iso,back", "If-None-Match: *\r\n")),
              304);
}

TEST_F(HttpTest, Still_AsFacts_IsJson) {
    const std::string answer =
        httpGetOnceThere(server_.port(), "/render?size=64x48&format=json&views=front,top");
    ASSERT_EQ(statusOf(answer), 200) << answer.substr(0, 400);
    EXPECT_NE(answer.find("Content-Type: application/json\r\n"), std::string::npos);
    const auto facts = nlohmann::json::parse(bodyOf(answer));
    EXPECT_EQ(facts.at("name"), "fake");
    EXPECT_EQ(facts.at("unit"), "metre");
    EXPECT_EQ(facts.at("bounds").at("size"), nlohmann::json({2.0, 2.0, 2.0}));
    EXPECT_EQ(facts.at("cameras"), nlohmann::json({"front", "side"}));
    ASSERT_EQ(facts.at("views").size(), 2U);
    EXPECT_EQ(facts.at("views")[1].at("view"), "top");
    const double black = facts.at("views")[0].at("near_black");
    EXPECT_TRUE(black >= 0 && black <= 1) << black;
    EXPECT_TRUE(facts.at("views")[0].contains("covered"));
    EXPECT_TRUE(facts.at("views")[0].at("nodes").is_array());
    EXPECT_EQ(facts.at("extensions").at("used"), nlohmann::json::array());
    const auto first = nlohmann::json::parse(bodyOf(get("/render?size=64x48&format=json")));
    EXPECT_EQ(first.at("views")[0].at("view"), "first");
    const auto top = nlohmann::json::parse(bodyOf(get("/render?size=64x48&format=json&view=top")));
    EXPECT_EQ(top.at("views")[0].at("view"), "top");
}

TEST_F(HttpTest, Still_ThatCannotBe_IsToldWhatWouldBeRight) {
    const std::tuple<std::string, int, std::string> cases[] = {
        {"lights=x", 400, R"("field":"lights")"},
        {"lights=1&lights=2", 400, "lights is given twice"},
        {"format=png&format=jpg", 400, "format is given twice"},
        {"scene=&scene=a", 400, "scene is given twice"},
        {"format=gif", 400, "it must be jpg, png, exr"},
        {"%6e%00=1", 400, R"(n\\x00 is not a name)"},
        {"format=json&lights=x", 400, R"("field":"lights")"},
        {"views=front,front", 400, "has \\\"front\\\" twice"},
        {"views=", 400, "each must be one of first, iso"},
        {"views=front&view=top", 400, "together with view"},
        {"views=front&format=exr", 400, "jpg, png and json alone"},
        {"scene=other", 404, "not a scene of this server"},
        {"size=4096x4096&antialiasing=ssaa4", 400, R"("fits":"2048x2048)"},
    };
    for (const auto& [query, status, text] : cases) {
        const std::string answer = httpGetOnceThere(server_.port(), "/render?" + query);
        EXPECT_EQ(statusOf(answer), status) << query;
        EXPECT_NE(answer.find(text), std::string::npos) << query << "\n" << answer;
    }
    const std::string post = exchange("POST /render HTTP/1.1\r\nHost: localhost\r\n"
                                      "Content-Length: 0\r\nConnection: close\r\n\r\n");
    EXPECT_EQ(statusOf(post), 411);
    const std::string put = exchange("PUT /render HTTP/1.1\r\nHost: localhost\r\n"
                                     "Connection: close\r\n\r\n");
    EXPECT_EQ(statusOf(put), 405);
    EXPECT_NE(put.find("Allow: GET, HEAD, POST\r\n"), std::string::npos) << put;
    EXPECT_EQ(statusOf(get("/render/more")), 404);
    EXPECT_EQ(statusOf(get("/rendering")), 404);
}

TEST_F(HttpTest, Still_OddQueriesAndConditions) {
    EXPECT_EQ(statusOf(httpGetOnceThere(server_.port(), "/render?&size=64x48&&lights=3&")), 200);
    const std::string any = "If-None-Match: *\r\n";
    EXPECT_EQ(statusOf(get("/render?size=64x48&lights=5", any)), 304);
    EXPECT_EQ(statusOf(get("/render?size=64x48&lights=x", any)), 400);
    EXPECT_EQ(statusOf(get("/", any)), 304);
}

// What a page of another site may show of it; a browser tells of such a page, a program of none.
TEST_F(HttpTest, Still_MayBeShownElsewhere_WhereNoTokenIsAsked) {
    const std::string query = "/render?size=64x48&lights=3";
    const std::string answer = httpGetOnceThere(server_.port(), query);
    EXPECT_NE(answer.find("Cross-Origin-Resource-Policy: cross-origin"), std::string::npos);
    EXPECT_NE(get("/").find("Cross-Origin-Resource-Policy: same-origin"), std::string::npos);
    const std::string foreign = "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: no-cors\r\n"
                                "Sec-Fetch-Dest: image\r\n";
    EXPECT_EQ(statusOf(get(query, foreign)), 403) << "of a server of this machine alone";
    TestServer named({.host_names = {"froxel.example"}});
    static_cast<void>(httpGetOnceThere(named.port(), query));
    const std::string shown = httpGet(named.port(), query, foreign);
    EXPECT_EQ(statusOf(shown), 200);
    EXPECT_NE(shown.find("Cross-Origin-Resource-Policy: cross-origin"), std::string::npos);
    EXPECT_EQ(shown.find("Access-Control-Allow-Origin"), std::string::npos) << "but not read";
    EXPECT_EQ(statusOf(httpGet(named.port(), "/api/v1/scenes", foreign)), 403);
}

TEST(HttpLoading, Still_WaitsForTheScene) {
    TestServer server({.open_at_once = false});
    auto answer = std::async(std::launch::async,
                             [&] { return httpGet(server.port(), "/render?size=64x48&lights=3"); });
    EXPECT_EQ(answer.wait_for(std::chrono::milliseconds(300)), std::future_status::timeout);
    server.open();
    EXPECT_EQ(statusOf(answer.get()), 200);
}

TEST_F(HttpTest, Answer_HasItsDate) {
    EXPECT_THAT(get("/"),
                testing::ContainsRegex("Date: [A-Z][a-z]{2}, [0-9]{2} [A-Z][a-z]{2} [0-9]{4} "
                                       "[0-9]{2}:[0-9]{2}:[0-9]{2} GMT\r\n"));
}

TEST_F(HttpTest, EmptyLinesBeforeARequest_AreNoPartOfIt) {
    const std::string request = "GET / HTTP/1.1\r\nHost: localhost\r\n";
    const std::string answer =
        exchange("\r\n\n\r\n" + request + "\r\n\r\n" + request + "Connection: close\r\n\r\n");
    EXPECT_EQ(statusOf(answer), 200);
    EXPECT_NE(answer.find("HTTP/1.1 200", 20), std::string::npos) << "the second, too";
}

TEST_F(HttpTest, HostIsMissing_Is400) {
    EXPECT_EQ(statusOf(exchange("GET / HTTP/1.1\r\nConnection: close\r\n\r\n")), 400);
    EXPECT_EQ(statusOf(exchange("GET / HTTP/1.0\r\n\r\n")), 200);
}

TEST_F(HttpTest, Target_InAbsoluteForm_IsServed) {
    const std::string answer = exchange("GET http://localhost/?x HTTP/1.1\r\nHost: other\r\n"
                                        "Connection: close\r\n\r\n");
    EXPECT_EQ(statusOf(answer), 200) << answer;
    EXPECT_NE(answer.find("<title>page</title>"), std::string::npos);
    const std::string foreign = "GET http://evil.example/ HTTP/1.1\r\nHost: localhost\r\n\r\n";
    EXPECT_EQ(statusOf(exchange(foreign)), 421) << "the target's host counts";
}

TEST_F(HttpTest, Host_Twice_Is400) {
    const std::string answer =
        exchange("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n");
    EXPECT_EQ(statusOf(answer), 400);
    EXPECT_NE(answer.find("the field Host came more than once"), std::string::npos) << answer;
}

// Lines of a list as clients and proxies may part them, and origins as they may spell them.
TEST_F(HttpTest, Upgrade_HoweverItIsWritten_IsTaken) {
    const std::string known = "Host: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              "Sec-WebSocket-Protocol: froxel.v1\r\n";
    const std::pair<std::string, int> cases[] = {
        {known, 101},
        {"Host: localhost\r\nUpgrade: websocket\r\nConnection: keep-alive\r\nConnection: "
         "Upgrade\r\nSec-WebSocket-Protocol: chat\r\nSec-WebSocket-Protocol: froxel.v1\r\n",
         101},
        {known + "Origin: http://localhost.:80\r\n", 101},
        {known + "Origin: http://localhost\r\nX-Forwarded-Proto: http\r\n", 101},
        {known + "Origin: http://localhost\r\nX-Forwarded-Proto: wss\r\n", 403},
        {known + "Origin: http://localhost\r\nX-Forwarded-Proto: https,http\r\n", 403},
        {known + "Origin: http://localhost\r\nX-Forwarded-Proto: https, https\r\n", 403},
        {known + "Origin: http://localhost\r\nX-Forwarded-Proto: http\r\nX-Forwarded-Proto: "
                 "https\r\n",
         403},
        {known + "Origin: https://localhost\r\nX-Forwarded-Proto: wss\r\n", 101},
        {known + "Origin: http://localhost\r\nOrigin: http://localhost\r\n", 400},
    };
    for (const auto& [lines, status] : cases) {
        RawWebSocket socket(server_.port(), false);
        socket.send("GET /ws HTTP/1.1\r\n" + lines +
                    "Sec-WebSocket-Version: 13\r\n"
                    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
        const std::string answer = socket.readHeader();
        EXPECT_EQ(statusOf(answer), status) << lines << answer;
    }
}

TEST_F(HttpTest, Page_HashedAsset_IsImmutable) {
    const std::string answer = get("/assets/main-1a2b.js");
    EXPECT_EQ(statusOf(answer), 200);
    EXPECT_NE(answer.find("Content-Type: text/javascript"), std::string::npos);
    EXPECT_NE(answer.find("immutable"), std::string::npos);
}

TEST_F(HttpTest, Page_SameETag_IsNotSentAgain) {
    const std::string answer = get("/");
    const size_t at = answer.find("ETag: ") + 6;
    const std::string etag = answer.substr(at, answer.find("\r\n", at) - at);
    const std::string again = get("/", "If-None-Match: " + etag + "\r\n");
    EXPECT_EQ(statusOf(again), 304);
    EXPECT_EQ(again.find("<title>"), std::string::npos);
}

TEST_F(HttpTest, Head_Page_HasTheLengthButNoBody) {
    const std::string answer =
        exchange("HEAD / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    EXPECT_EQ(statusOf(answer), 200);
    EXPECT_NE(answer.find("Content-Length: 34"), std::string::npos) << answer;
    EXPECT_TRUE(answer.ends_with("\r\n\r\n"));
}

TEST_F(HttpTest, KeepAlive_TwoRequests_BothAreAnswered) {
    const std::string answer =
        exchange("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
                 "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    EXPECT_NE(answer.find("status"), std::string::npos);
    EXPECT_NE(answer.find("<title>page"), std::string::npos);
}

TEST_F(HttpTest, Paths_ThatTryToEscape_AreNotFound) {
    for (const std::string& target : {std::string("/../secret.txt"),
                                      std::string("/../../etc/passwd"),
                                      std::string("/%2e%2e/secret.txt"),
                                      std::string("/%252e%252e/secret.txt"),
                                      std::string("/..%5csecret.txt"),
                                      std::string("/..\\secret.txt"),
                                      std::string("//etc/passwd"),
                                      std::string("/assets/../../secret.txt"),
                                      std::string("/assets/%2e%2e/%2e%2e/secret.txt"),
                                      std::string("/./index.html"),
                                      std::string("//index.html"),
                                      std::string("/index.html/"),
                                      std::string("/index.html%00"),
                                      std::string("/link.txt"),
                                      std::string("/assets"),
                                      std::string("/assets/"),
                                      std::string("/INDEX.HTML"),
                                      std::string("http://localhost/etc/passwd"),
                                      std::string("*"),
                                      "/" + std::string(4000, 'a')}) {
        const std::string answer = get(target);
        EXPECT_EQ(statusOf(answer), 404) << target << "\n" << answer;
        EXPECT_EQ(answer.find("secret\n"), std::string::npos) << target;
    }
}

TEST_F(HttpTest, Methods_OtherThanGetAndHead_AreNotAllowed) {
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "FOO"}) {
        const std::string answer =
            exchange(std::string(method) + " / HTTP/1.1\r\nHost: localhost\r\n"
                                           "Connection: close\r\n\r\n");
        EXPECT_EQ(statusOf(answer), 405) << method << answer;
        EXPECT_NE(answer.find("Allow: GET, HEAD"), std::string::npos) << method;
    }
}

TEST_F(HttpTest, Header_OverTheLimit_Is431) {
    const std::string answer = get("/", "X-Bomb: " + std::string(9000, 'x') + "\r\n");
    EXPECT_EQ(statusOf(answer), 431);
}

TEST_F(HttpTest, Header_NeverEnds_Is408) {
    EXPECT_EQ(statusOf(exchange("GET / HTTP/1.1\r\nHost: lo")), 408);
}

TEST_F(HttpTest, Requests_Malformed_AreBadAndTheServerLives) {
    for (const std::string& raw :
         {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 tls hello", 22),
          std::string("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\nContent-Length: "
                      "2\r\n\r\n"),
          std::string("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n"),
          std::string("GET / HTTP/3.7\r\n\r\n"), std::string("nonsense\r\n\r\n")}) {
        EXPECT_EQ(statusOf(exchange(raw)), 400) << raw;
    }
    EXPECT_EQ(statusOf(get("/")), 200);
}

TEST_F(HttpTest, Body_Any_IsRefused) {
    const std::string answer =
        exchange("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nhello");
    EXPECT_EQ(statusOf(answer), 413);
}

TEST_F(HttpTest, Socket_WithoutUpgrade_Is426) {
    EXPECT_EQ(statusOf(get("/ws")), 426);
}

TEST_F(HttpTest, Socket_UpgradeElsewhere_Is404) {
    EXPECT_EQ(statusOf(exchange("GET /other HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
                                "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")),
              404);
}

TEST_F(HttpTest, Socket_ForeignOrigin_Is403) {
    EXPECT_EQ(statusOf(exchange("GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
                                "Origin: http://b\r\n"
                                "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")),
              403);
}

TEST_F(HttpTest, NameOfAnother_IsMisdirectedWhateverIsAsked) {
    const std::string rebound = " HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n";
    EXPECT_EQ(statusOf(exchange("GET /" + rebound)), 421);
    EXPECT_EQ(statusOf(httpExchange(server_.adminPort(), "GET /metrics" + rebound)), 421);
    EXPECT_EQ(statusOf(exchange("GET /ws HTTP/1.1\r\nHost: evil.example\r\nUpgrade: websocket\r\n"
                                "Origin: http://evil.example\r\n"
                                "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Protocol: froxel.v1\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")),
              421);
}

TEST_F(HttpTest, Socket_SubprotocolIsNotOffered_Is400) {
    EXPECT_EQ(statusOf(exchange("GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
                                "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")),
              400);
}

TEST_F(HttpTest, Health_Serving_SaysSo) {
    WsClient(server_.port()).join(); // the scene is there
    const std::string answer = get("/healthz");
    EXPECT_EQ(statusOf(answer), 200);
    EXPECT_NE(answer.find(R"({"status":"serving"})"), std::string::npos) << answer;
    EXPECT_NE(answer.find("no-store"), std::string::npos);
}

TEST_F(HttpTest, Metrics_AreNotHere) {
    const std::string answer = get("/metrics");
    EXPECT_EQ(statusOf(answer), 404);
    EXPECT_EQ(answer.find("froxel_"), std::string::npos) << answer;
}

TEST(HttpLoading, SceneIsNotThere_PageAndHealthAnswer) {
    TestServer server({.open_at_once = false});
    const std::string answer = httpGet(server.port(), "/healthz");
    EXPECT_NE(answer.find(R"({"status":"loading"})"), std::string::npos) << answer;
}

} // namespace
} // namespace froxel::test
