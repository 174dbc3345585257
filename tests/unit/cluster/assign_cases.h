// Scenes of lights for the assignment tests, and the comparison with the oracle.
#pragma once

#include "cluster/assign_reference.h"
#include "cluster/cluster_grid.h"
#include "cluster/light_assigner.h"
#include "light/frame_lights.h"
#include "settings/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace froxel::cluster::testing {

inline constexpr float kUnlimited = std::numeric_limits<float>::infinity();

inline settings::Camera perspective(double fov_deg) {
    settings::Camera camera;
    camera.yfov_rad = glm::radians(fov_deg);
    return camera;
}

inline settings::Camera orthographic(double half_height_m) {
    settings::Camera camera;
    camera.projection = settings::Projection::kOrthographic;
    camera.half_height_m = half_height_m;
    camera.near_m = 0;
    return camera;
}

inline void addPoint(light::FrameLights& lights, const glm::dvec3& position_view, double radius_m) {
    io::Light light{};
    light.position_view = glm::vec3(position_view);
    light.inv_radius2 = std::isinf(radius_m) ? 0.0F : static_cast<float>(1 / (radius_m * radius_m));
    light.color = glm::vec3(1);
    light.spot = io::kNoSpot;
    lights.lights.push_back(light);
    lights.radii_m.push_back(static_cast<float>(radius_m));
}

inline void addSpot(light::FrameLights& lights,
                    const glm::dvec3& position_view,
                    double radius_m,
                    const glm::dvec3& direction_view,
                    double outer_deg) {
    addPoint(lights, position_view, radius_m);
    lights.lights.back().spot = static_cast<uint32_t>(lights.spots.size());
    io::Spot spot{};
    spot.direction_view = glm::vec3(glm::normalize(direction_view));
    lights.spots.push_back(spot);
    const double outer = glm::radians(outer_deg);
    lights.cones.push_back({std::cos(outer), std::sin(outer)});
}

// A light's ball in the axes of Cell, its radius scaled.
inline Ball ballOf(const light::FrameLights& lights, size_t index, double scale = 1) {
    const glm::dvec3 p(lights.lights[index].position_view);
    return {p.x, -p.y, -p.z, static_cast<double>(lights.radii_m[index]) * scale};
}

// Clusters whose list holds each light; also checks that lists are compact and ascend.
inline std::vector<std::vector<uint32_t>> clustersByLight(const LightLists& lists,
                                                          size_t light_count) {
    std::vector<std::vector<uint32_t>> clusters(light_count);
    uint32_t offset = 0;
    for (uint32_t cluster = 0; cluster < lists.clusters.size(); ++cluster) {
        const io::ClusterList& list = lists.clusters[cluster];
        EXPECT_EQ(list.offset, offset);
        offset += list.count;
        for (uint32_t i = 0; i < list.count; ++i) {
            const uint32_t light = lists.indices[list.offset + i];
            EXPECT_TRUE(i == 0 || lists.indices[list.offset + i - 1] < light);
            clusters.at(light).push_back(cluster);
        }
    }
    EXPECT_EQ(offset, lists.indices.size());
    EXPECT_EQ(lists.stats.entry_count, lists.indices.size());
    return clusters;
}

inline LightLists
assigned(const ClusterGrid& grid, const light::FrameLights& lights, unsigned threads = 1) {
    LightAssigner assigner(threads);
    LightLists lists;
    assigner.assign(grid, lights, lists);
    return lists;
}

// How much larger (of the radius, and of the distance to the eye) a ball may be taken to be.
inline constexpr double kAllowed = 4e-6;

// Every point light is in each list whose cell its ball meets, and in no list whose cell is farther
// than a ball larger by kAllowed.
inline void expectExact(const ClusterGrid& grid, const light::FrameLights& lights) {
    const LightLists lists = assigned(grid, lights);
    const auto clusters = clustersByLight(lists, lights.lights.size());
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const Ball ball = ballOf(lights, i);
        Ball larger = ball;
        larger.radius += kAllowed * (ball.radius + glm::length(glm::dvec3(ball.x, ball.y, ball.z)));
        const auto needed = reference::clustersOf(grid, ball);
        const auto allowed = reference::clustersOf(grid, larger);
        const std::string what = "light " + std::to_string(i) + " at " + std::to_string(ball.x) +
                                 " " + std::to_string(ball.y) + " " + std::to_string(ball.z) +
                                 " r " + std::to_string(ball.radius);
        ASSERT_TRUE(
            std::includes(clusters[i].begin(), clusters[i].end(), needed.begin(), needed.end()))
            << what << ": a cluster is missing";
        ASSERT_TRUE(
            std::includes(allowed.begin(), allowed.end(), clusters[i].begin(), clusters[i].end()))
            << what << ": a cluster too many";
    }
}

} // namespace froxel::cluster::testing
