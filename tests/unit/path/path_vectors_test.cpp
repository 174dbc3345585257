// Where cameras are along the paths of protocol/vectors/paths.json, which the page's own maths is
// held against. Run with FROXEL_WRITE_VECTORS=1 to compute `views` anew.
#include "path/built_in_paths.h"
#include "path/path_file.h"
#include "support/places.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace froxel::path {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTolerance = 1e-12; // of numbers, in proportion: libraries round otherwise

settings::Camera cameraOf(const Json& view) {
    const Json file = {{"keys", Json::array({view})}};
    return parsePath(file.dump()).value().keys.front().camera;
}

glm::dvec3 placeOf(const Json& list) {
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

PathKeys keysOf(const Json& vector) {
    if (vector.contains("path")) {
        return parsePath(vector["path"].dump()).value();
    }
    scene::Scene scene;
    for (const Json& view : vector.value("cameras", Json::array())) {
        scene.cameras.push_back({"", cameraOf(view)});
    }
    if (vector.contains("box")) {
        scene.bounds_world = {placeOf(vector["box"][0]), placeOf(vector["box"][1])};
    }
    const auto which =
        vector["built_in"] == "turntable" ? BuiltIn::kTurntable : BuiltIn::kFlythrough;
    return builtInPath(which, scene, cameraOf(vector["first"]), vector["seconds"].get<double>());
}

Json viewOf(const settings::Camera& camera) {
    const auto list = [](const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); };
    return {{"eye", list(camera.eye_world)},
            {"target", list(camera.target_world())},
            {"up", list(camera.world_from_view[1])},
            {"fov_deg", glm::degrees(camera.yfov_rad)}};
}

Json viewsOf(const Json& vector) {
    const CameraPath path(keysOf(vector));
    Json views = Json::array();
    for (const Json& time : vector["times"]) {
        views.push_back(viewOf(path.at(time.get<double>())));
    }
    return views;
}

void expectNear(const Json& value, const Json& expected, const std::string& where) {
    if (expected.is_number()) {
        const double wanted = expected.get<double>();
        EXPECT_NEAR(value.get<double>(), wanted, kTolerance * std::max(1.0, std::abs(wanted)))
            << where;
        return;
    }
    ASSERT_EQ(value.size(), expected.size()) << where;
    for (const auto& [key, inner] : expected.items()) {
        const Json& own = expected.is_array() ? value.at(std::stoul(key)) : value.at(key);
        expectNear(own, inner, where + "/" + key);
    }
}

TEST(PathVectors, Views_AreThoseOfTheFile) {
    const auto file = test::repositoryPath("protocol/vectors") / "paths.json";
    Json vectors;
    {
        std::ifstream stream(file);
        ASSERT_TRUE(stream) << file;
        vectors = Json::parse(stream);
    }
    if (std::getenv("FROXEL_WRITE_VECTORS") != nullptr) {
        for (Json& vector : vectors) {
            vector["views"] = viewsOf(vector);
        }
        std::ofstream(file) << vectors.dump(1) << "\n";
    }
    for (const Json& vector : vectors) {
        expectNear(viewsOf(vector), vector.at("views"), vector["name"].get<std::string>());
    }
}

} // namespace
} // namespace froxel::path
