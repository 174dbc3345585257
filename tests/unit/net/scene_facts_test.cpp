#include "net/scene_facts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace froxel::net {
namespace {

using nlohmann::json;

json coverage(const session::SceneSummary& scene, const still::CoveredPixels& pixels) {
    return json::parse(coverageOf(scene, pixels).dump());
}

TEST(SceneFacts, Coverage_AddsUpANodesInstances_MostPixelsFirst) {
    session::SceneSummary scene;
    scene.nodes = {{0, 4, "floor"}, {1, 9, "trees"}, {5, scene::kNone, ""}};
    const json facts = coverage(scene, {40, {{0, 5}, {1, 2}, {3, 4}, {5, 1}}});
    EXPECT_EQ(facts, json::parse(R"({"covered": 0.3, "nodes_left_out": 0, "nodes": [
        {"node": 9, "name": "trees", "pixels": 6},
        {"node": 4, "name": "floor", "pixels": 5},
        {"node": null, "name": "", "pixels": 1}]})"));
}

TEST(SceneFacts, Coverage_OfManyNodes_ListsAHundredAndCountsTheRest) {
    session::SceneSummary scene;
    still::CoveredPixels pixels{1000, {}};
    for (uint32_t i = 0; i < 130; ++i) {
        scene.nodes.push_back({i, i, "n" + std::to_string(i)});
        pixels.of_instance[i] = i + 1;
    }
    const json facts = coverage(scene, pixels);
    EXPECT_EQ(facts.at("nodes").size(), 100U);
    EXPECT_EQ(facts.at("nodes")[0].at("name"), "n129");
    EXPECT_EQ(facts.at("nodes_left_out"), 30);
}

TEST(SceneFacts, Coverage_OfAnEmptyPicture_IsNothing) {
    EXPECT_EQ(coverage({}, {40, {}}),
              json::parse(R"({"covered": 0.0, "nodes": [], "nodes_left_out": 0})"));
}

} // namespace
} // namespace froxel::net
