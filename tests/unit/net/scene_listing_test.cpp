#include "net/scene_listing.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>

namespace froxel::net {
namespace {

namespace fs = std::filesystem;
namespace http = boost::beast::http;
using nlohmann::json;
using ::testing::HasSubstr;

class SceneListingTest : public testing::Test {
  protected:
    SceneListingTest() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~SceneListingTest() override { fs::remove_all(folder_); }
    void write(const std::string& name) { std::ofstream(folder_ / name) << "12345"; }
    [[nodiscard]] SceneListing listing() const {
        const catalogue::Offered hall{"builtin", "hall", "", "builtin", 0, 0};
        return {std::make_shared<const catalogue::Catalogue>(std::vector<catalogue::Offered>{hall},
                                                             folder_),
                std::make_shared<const Service>()};
    }
    static Request get(const std::string& target) { return {http::verb::get, target, 11}; }
    static Response ask(const SceneListing& listing, const std::string& target) {
        const Request request = get(target);
        return listing.answer(request, pathOf(request));
    }

    const fs::path folder_ = fs::path(testing::TempDir()) / "froxel_scene_listing_test";
};

TEST_F(SceneListingTest, Listing_HasEachSceneWithItsFacts) {
    write("fox.glb");
    const SceneListing all = listing();
    const Response answer = ask(all, "/api/v1/scenes");
    EXPECT_EQ(answer.result(), http::status::ok);
    const json scenes = json::parse(answer.body()).at("scenes");
    ASSERT_EQ(scenes.size(), 2U);
    const std::string thumb = scenes[0].at("thumb");
    EXPECT_TRUE(thumb.starts_with("/api/v1/scenes/builtin/thumb?v=")) << thumb;
    EXPECT_EQ(scenes[0], json({{"id", "builtin"},
                               {"name", "hall"},
                               {"path", ""},
                               {"kind", "builtin"},
                               {"bytes", 0},
                               {"thumb", thumb},
                               {"state", "offered"}}));
    EXPECT_EQ(scenes[1].at("name"), "fox");
    EXPECT_EQ(scenes[1].at("kind"), "glb");
    EXPECT_EQ(scenes[1].at("bytes"), 5);
    const std::string id = scenes[1].at("id");
    EXPECT_EQ(json::parse(ask(all, "/api/v1/scenes/" + id).body()), scenes[1]);
}

// Whoever goes through the pages while files come and go misses none that stays.
TEST_F(SceneListingTest, PageAfterASceneThatHasGone_GoesOnWhereItWas) {
    for (const char* name : {"a.glb", "b.glb", "c.glb", "d.glb"}) {
        write(name);
    }
    const auto catalogue = std::make_shared<catalogue::Catalogue>(
        std::vector<catalogue::Offered>{{"builtin", "hall", "", "builtin", 0, 0}}, folder_);
    const SceneListing all(catalogue, std::make_shared<const Service>());
    const json first = json::parse(ask(all, "/api/v1/scenes?limit=3").body());
    const std::string last = first.at("next"); // b
    fs::remove(folder_ / "b.glb");
    catalogue->rescan();
    write("e.glb");
    catalogue->rescan();
    const json then = json::parse(ask(all, "/api/v1/scenes?after=" + last).body());
    ASSERT_EQ(then.at("scenes").size(), 3U);
    EXPECT_EQ(then.at("scenes")[0].at("name"), "c");
    EXPECT_EQ(ask(all, "/api/v1/scenes?after=nobody").result(), http::status::bad_request);
}

TEST_F(SceneListingTest, Pages_FollowEachOther) {
    for (const char* name : {"a.glb", "b.glb", "c.glb"}) {
        write(name);
    }
    const SceneListing all = listing();
    std::vector<std::string> names;
    std::string after;
    for (int page = 0; page < 2; ++page) {
        const json body = json::parse(ask(all, "/api/v1/scenes?limit=2" + after).body());
        for (const json& scene : body.at("scenes")) {
            names.push_back(scene.at("name"));
        }
        ASSERT_EQ(body.contains("next"), page == 0);
        after = page == 0 ? "&after=" + body.at("next").get<std::string>() : "";
    }
    EXPECT_EQ(names, (std::vector<std::string>{"hall", "a", "b", "c"}));
}

TEST_F(SceneListingTest, Unchanged_Is304) {
    const SceneListing all = listing();
    Request request = get("/api/v1/scenes");
    const Response first = all.answer(request, "/api/v1/scenes");
    request.set(http::field::if_none_match, first[http::field::etag]);
    EXPECT_EQ(all.answer(request, "/api/v1/scenes").result(), http::status::not_modified);
    write("new.glb");
    EXPECT_EQ(listing().answer(request, "/api/v1/scenes").result(), http::status::ok);
}

TEST_F(SceneListingTest, BadRequests_AreToldWhatWouldBeRight) {
    const SceneListing all = listing();
    for (const char* limit : {"0", "201", "-1", "1e3", "", "99999999999999999999"}) {
        const Response refused = ask(all, std::string("/api/v1/scenes?limit=") + limit);
        EXPECT_EQ(refused.result(), http::status::bad_request) << limit;
        EXPECT_THAT(refused.body(), HasSubstr("it must be from 1 to 200"));
    }
    EXPECT_EQ(ask(all, "/api/v1/scenes?after=zz").result(), http::status::bad_request);
    for (const char* id : {"zz", "", "../../etc/passwd", "%00", "builtin/"}) {
        EXPECT_EQ(ask(all, std::string("/api/v1/scenes/") + id).result(), http::status::not_found)
            << id;
    }
}

TEST_F(SceneListingTest, NamesOfAnyBytes_AreValidJson) {
    write("<img src=x onerror=alert(1)>.glb");
    write("\xff\xfe\"\\.glb");
    const json scenes = json::parse(ask(listing(), "/api/v1/scenes").body()).at("scenes");
    ASSERT_EQ(scenes.size(), 3U);
    EXPECT_EQ(scenes[1].at("name"), "<img src=x onerror=alert(1)>");
}

TEST_F(SceneListingTest, ServerOfOneScene_HasNone) {
    const SceneListing none(nullptr, std::make_shared<const Service>());
    EXPECT_EQ(ask(none, "/api/v1/scenes").result(), http::status::not_found);
    EXPECT_TRUE(SceneListing::has("/api/v1/scenes"));
    EXPECT_TRUE(SceneListing::has("/api/v1/scenes/x"));
    EXPECT_FALSE(SceneListing::has("/api/v1/scenesx"));
}

} // namespace
} // namespace froxel::net
