// How many entries of light lists are in vain: their light reaches no point of their cluster, by
// sampling. Beside them a test of every ball against every cluster's box in view space.
//
//   cmake --build build/test --target list_tightness && build/test/tests/bench/list_tightness
#include "cluster/depth_range.h"
#include "cluster/light_assigner.h"
#include "light/light_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace froxel {
namespace {

// Points of a cell a side. A cell may be met between them, so exact lists show a share above 0.
constexpr int kSteps = 12;

struct Case {
    const char* name;
    scene::Scene scene;
    settings::ViewSettings settings;
    double spot_half_angle_deg = 0; // 0: points
};

Case sponza(const char* name, uint32_t count, float radius_m, double spot_half_angle_deg = 0) {
    Case c{.name = name, .scene = {}, .settings = {}, .spot_half_angle_deg = spot_half_angle_deg};
    c.scene.bounds_world = {{-15, -1, -9}, {14, 12, 9}};
    c.settings.camera = settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0});
    c.settings.lights.count = count;
    c.settings.lights.radius_m = radius_m;
    c.settings.lights.box = BoundsD3{{-10, 0, -5}, {10, 8, 5}};
    return c;
}

// The built-in hall, seen along its nave.
Case hall(const char* name, uint32_t count, float radius_m) {
    Case c{.name = name, .scene = {}, .settings = {}};
    c.scene.bounds_world = {{-13, 0, -33}, {13, 16, 33}};
    c.settings.camera = settings::lookAt({0, 2, 30}, {0, 3, 0}, {0, 1, 0});
    c.settings.lights.count = count;
    c.settings.lights.radius_m = radius_m;
    return c;
}

void makeSpots(light::FrameLights& lights, double half_angle_deg) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    const double outer = glm::radians(half_angle_deg);
    for (io::Light& light : lights.lights) {
        light.spot = static_cast<uint32_t>(lights.spots.size());
        const glm::dvec3 way(unit(random), unit(random), unit(random));
        io::Spot spot{};
        spot.direction_view = glm::vec3(glm::normalize(way));
        lights.spots.push_back(spot);
        lights.cones.push_back({std::cos(outer), std::sin(outer)});
    }
}

struct Light {
    glm::dvec3 position; // in the axes of Cell
    glm::dvec3 axis;
    double radius;
    double cos_outer; // -1: a point light

    [[nodiscard]] bool reaches(const glm::dvec3& point) const {
        const glm::dvec3 way = point - position;
        const double length2 = glm::dot(way, way);
        return length2 < radius * radius &&
               (cos_outer <= -1 || glm::dot(way, axis) >= cos_outer * std::sqrt(length2));
    }
};

Light lightOf(const light::FrameLights& lights, size_t index) {
    const io::Light& light = lights.lights[index];
    Light l{.position = {light.position_view.x, -light.position_view.y, -light.position_view.z},
            .axis = {},
            .radius = static_cast<double>(lights.radii_m[index]),
            .cos_outer = -1};
    if (light.spot != io::kNoSpot) {
        const glm::dvec3 way(lights.spots[light.spot].direction_view);
        l.axis = glm::normalize(glm::dvec3(way.x, -way.y, -way.z));
        l.cos_outer = lights.cones[light.spot].cos_outer;
    }
    return l;
}

bool reachesAPoint(const cluster::Cell& cell, const Light& light) {
    for (int i = 0; i <= kSteps; ++i) {
        const double z = cell.z0 + (cell.z1 - cell.z0) * i / kSteps;
        for (int j = 0; j <= kSteps; ++j) {
            const double y = (cell.y0 + (cell.y1 - cell.y0) * j / kSteps) * z;
            for (int k = 0; k <= kSteps; ++k) {
                const double x = (cell.x0 + (cell.x1 - cell.x0) * k / kSteps) * z;
                if (light.reaches({x, y, z})) {
                    return true;
                }
            }
        }
    }
    return false;
}

bool holds(const cluster::Cell& cell, const glm::dvec3& p) {
    return p.z >= cell.z0 && p.z <= cell.z1 && p.x >= cell.x0 * p.z && p.x <= cell.x1 * p.z &&
           p.y >= cell.y0 * p.z && p.y <= cell.y1 * p.z;
}

// From the other side: a narrow cone passes between the points of a cell.
bool coneMeets(const cluster::Cell& cell, const Light& light) {
    const glm::dvec3 side =
        std::abs(light.axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(light.axis, side));
    const glm::dvec3 v = glm::cross(light.axis, u);
    const double outer = std::acos(light.cos_outer);
    for (int ring = 0; ring <= 4; ++ring) {
        const double angle = outer * ring / 4;
        for (int turn = 0; turn < 24; ++turn) {
            const double around = glm::radians(15.0 * turn);
            const glm::dvec3 way = light.axis * std::cos(angle) +
                                   (u * std::cos(around) + v * std::sin(around)) * std::sin(angle);
            for (int step = 0; step <= 32; ++step) {
                if (holds(cell, light.position + way * (light.radius * step / 32))) {
                    return true;
                }
            }
        }
    }
    return false;
}

bool boxMeetsBall(const cluster::Cell& cell, const Light& light) {
    const auto away = [](double value, double a, double b, double c, double d) {
        return std::max({0.0, std::min({a, b, c, d}) - value, value - std::max({a, b, c, d})});
    };
    const double x = away(light.position.x, cell.x0 * cell.z0, cell.x0 * cell.z1, cell.x1 * cell.z0,
                          cell.x1 * cell.z1);
    const double y = away(light.position.y, cell.y0 * cell.z0, cell.y0 * cell.z1, cell.y1 * cell.z0,
                          cell.y1 * cell.z1);
    const double z = away(light.position.z, cell.z0, cell.z0, cell.z1, cell.z1);
    return x * x + y * y + z * z <= light.radius * light.radius;
}

void report(const Case& c, const cluster::GridShape& shape) {
    const light::LightRig rig(c.scene);
    light::FrameLights lights;
    rig.evaluate(c.settings.lights, c.settings.camera, 0, lights);
    if (c.spot_half_angle_deg > 0) {
        makeSpots(lights, c.spot_half_angle_deg);
    }
    const auto range = cluster::litDepthRange(lights, c.settings.camera, c.scene.bounds_world);
    const auto grid = cluster::makeClusterGrid(shape, c.settings.size, c.settings.camera,
                                               range.near_m, range.far_m);
    cluster::LightAssigner assigner(1);
    cluster::LightLists lists;
    assigner.assign(grid, lights, lists);
    uint64_t in_vain = 0;
    uint64_t box_entries = 0;
    for (uint32_t i = 0; i < grid.clusterCount(); ++i) {
        const uint32_t x = i % grid.size.x;
        const uint32_t y = i / grid.size.x % grid.size.y;
        if (x >= grid.usedColumns() || y >= grid.usedRows()) {
            continue;
        }
        const cluster::Cell cell = grid.cell(x, y, i / (grid.size.x * grid.size.y));
        const io::ClusterList& list = lists.clusters[i];
        for (uint32_t entry = 0; entry < list.count; ++entry) {
            const Light light = lightOf(lights, lists.indices[list.offset + entry]);
            const bool met =
                reachesAPoint(cell, light) || (light.cos_outer > -1 && coneMeets(cell, light));
            in_vain += met ? 0U : 1U;
        }
        for (size_t light = 0; light < lights.lights.size(); ++light) {
            box_entries += boxMeetsBall(cell, lightOf(lights, light)) ? 1U : 0U;
        }
    }
    const uint64_t entries = lists.indices.size();
    const uint64_t needed = entries - in_vain;
    const auto share = [](uint64_t part, uint64_t whole) {
        return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
    };
    std::printf("%-22s %3ux%2ux%2u %9lu %6.2f %% %9lu %6.2f %%\n", c.name, grid.size.x, grid.size.y,
                grid.size.z, static_cast<unsigned long>(entries), share(in_vain, entries),
                static_cast<unsigned long>(box_entries), share(box_entries - needed, box_entries));
}

void reportAll() {
    std::printf("%-22s %-9s %9s %8s %9s %8s\n", "lights", "grid", "entries", "in vain", "box test",
                "in vain");
    const std::array grids = {cluster::GridShape{{16, 9, 24}, {}, 80, 80},
                              cluster::GridShape{{40, 23, 16}, {}, 32, 32}};
    for (const auto& grid : grids) {
        report(sponza("Sponza 300 x 2 m", 300, 2), grid);
        report(sponza("Sponza 1000 x 0.5 m", 1000, 0.5F), grid);
        report(hall("hall 300 x 3 m", 300, 3), grid);
        report(sponza("spots 15 deg x 4 m", 300, 4, 15), grid);
        report(sponza("spots 35 deg x 4 m", 300, 4, 35), grid);
        report(sponza("spots 60 deg x 4 m", 300, 4, 60), grid);
    }
}

} // namespace
} // namespace froxel

int main() {
    froxel::reportAll();
}
