// The guarantee itself, from the shader's side: pixels as fp32 shading sees them, lists from the
// assigner. Also how many entries of the lists are in vain.
#include "assign_cases.h"

#include <cmath>
#include <ostream>

namespace froxel::cluster::testing {
namespace {

light::FrameLights
scattered(std::mt19937& random, int count, double spread, double far_m, double radius) {
    std::uniform_real_distribution<double> unit(-1, 1);
    light::FrameLights lights;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 position(spread * unit(random), spread * unit(random),
                                  -far_m * (0.5 + 0.6 * unit(random)));
        const double own_radius = radius * (0.6 + 0.4 * unit(random));
        if (i % 3 == 0) {
            addSpot(lights, position, own_radius, {unit(random), unit(random), unit(random)},
                    45 + 44 * unit(random));
            io::Spot& spot = lights.spots.back();
            const double scale = 1 / std::max(1e-3, 1 - lights.cones.back().cos_outer);
            spot.scale = static_cast<float>(scale);
            spot.offset = static_cast<float>(-lights.cones.back().cos_outer * scale);
        } else {
            addPoint(lights, position, own_radius);
        }
    }
    return lights;
}

// Falloff above 0, in the shader's fp32 arithmetic.
bool reaches(const light::FrameLights& lights, const io::Light& light, const glm::vec3& point) {
    const glm::vec3 to_light = light.position_view - point;
    const float distance2 = glm::dot(to_light, to_light);
    if (distance2 * light.inv_radius2 >= 1) {
        return false;
    }
    if (light.spot == io::kNoSpot || distance2 == 0) {
        return true;
    }
    const io::Spot& spot = lights.spots[light.spot];
    const glm::vec3 way = to_light * (1 / std::sqrt(distance2));
    return glm::dot(spot.direction_view, -way) * spot.scale + spot.offset > 0;
}

struct Scene {
    const char* name;
    settings::Size image;
    settings::GridSize grid;
    settings::Camera camera;
    double spread;
    double far_m;
    double radius;
};

void PrintTo(const Scene& scene, std::ostream* out) {
    *out << scene.name;
}

class AssignShading : public ::testing::TestWithParam<Scene> {};

TEST_P(AssignShading, Fp32Pixels_FindEveryLightThatReachesThem) {
    const Scene& scene = GetParam();
    std::mt19937 random(21);
    const auto lights = scattered(random, 300, scene.spread, scene.far_m, scene.radius);
    const ClusterGrid grid = makeClusterGrid({scene.grid}, scene.image, scene.camera,
                                             scene.far_m / 100, scene.far_m * 1.5);
    const LightLists lists = assigned(grid, lights);
    const bool flat = scene.camera.projection == settings::Projection::kOrthographic;
    std::uniform_int_distribution<uint32_t> column(0, scene.image.width_px - 1);
    std::uniform_int_distribution<uint32_t> row(0, scene.image.height_px - 1);
    std::uniform_int_distribution<size_t> plane(0, grid.size.z);
    std::uniform_real_distribution<double> unit(0, 1);
    size_t reached = 0;
    for (int i = 0; i < 20'000; ++i) {
        const uint32_t px = column(random);
        const uint32_t py = row(random);
        // Half of the points lie within an ulp of a slice's plane.
        auto depth = static_cast<float>(scene.far_m * 1.5 * unit(random));
        if (i % 2 == 0) {
            depth = std::nextafter(grid.plane_depths_m[plane(random)], i % 4 == 0 ? 0.0F : 1e9F);
        }
        const auto slice = grid.sliceAt(depth);
        if (!slice) {
            continue;
        }
        const float scale = flat ? 1.0F : depth;
        const auto half_x = static_cast<float>(grid.half_x);
        const auto half_y = static_cast<float>(grid.half_y);
        const float x =
            (2 * (static_cast<float>(px) + 0.5F) / static_cast<float>(scene.image.width_px) - 1) *
            half_x;
        const float y =
            (1 - 2 * (static_cast<float>(py) + 0.5F) / static_cast<float>(scene.image.height_px)) *
            half_y;
        const glm::vec3 point(x * scale, y * scale, -depth);
        const uint32_t cluster =
            grid.clusterIndex(px / grid.tile_width_px, py / grid.tile_height_px, *slice);
        const auto begin = lists.indices.begin() + lists.clusters[cluster].offset;
        const auto end = begin + lists.clusters[cluster].count;
        for (uint32_t light = 0; light < lights.lights.size(); ++light) {
            if (reaches(lights, lights.lights[light], point)) {
                ++reached;
                ASSERT_TRUE(std::binary_search(begin, end, light))
                    << "light " << light << " at pixel " << px << " " << py << " depth " << depth;
            }
        }
    }
    EXPECT_GT(reached, 1000U);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes,
    AssignShading,
    ::testing::Values(Scene{"usual", {1280, 720}, {16, 9, 24}, perspective(45), 8, 20, 3},
                      Scene{"fine", {640, 360}, {128, 90, 64}, perspective(70), 8, 20, 2},
                      Scene{"wide", {1919, 1079}, {32, 16, 64}, perspective(120), 20, 20, 4},
                      Scene{"tiny_picture", {17, 33}, {15, 15, 15}, perspective(60), 5, 20, 3},
                      Scene{"far", {640, 360}, {16, 9, 24}, perspective(45), 4e4, 1e5, 2e4},
                      Scene{"near", {640, 360}, {16, 9, 24}, perspective(45), 4e-3, 1e-2, 2e-3},
                      Scene{"orthographic", {640, 360}, {16, 9, 24}, orthographic(5), 8, 20, 3}));

// Lights whose rim, by fp32 rounding alone, reaches the first depth of the next slice: from in
// front of the plane, the smallest radius that the shader's arithmetic accepts.
TEST(AssignRim, OnASlicePlane_IsInTheSliceBehindIt) {
    const ClusterGrid grid = makeClusterGrid({4, 4, 24}, {640, 360}, perspective(45), 0.5, 200);
    std::mt19937 random(8);
    std::uniform_real_distribution<float> unit(-1, 1);
    light::FrameLights lights;
    std::vector<uint32_t> expected;
    for (int i = 0; i < 4000; ++i) {
        const uint32_t slice = 1 + static_cast<uint32_t>(i) % 23;
        const float plane = grid.plane_depths_m[slice];
        const glm::vec3 point(0.1F * plane, 0.05F * plane * unit(random), -plane);
        const float reach = plane * (0.4F + 0.3F * unit(random));
        addPoint(lights, {point.x, point.y, -plane + reach}, static_cast<double>(reach));
        io::Light& light = lights.lights.back();
        float& radius = lights.radii_m.back();
        radius *= 1 - 3e-7F;
        for (;;) {
            const auto exact = static_cast<double>(radius);
            light.inv_radius2 = static_cast<float>(1 / (exact * exact));
            if (reaches(lights, light, point)) {
                break;
            }
            radius = std::nextafter(radius, kUnlimited);
        }
        const auto column = static_cast<uint32_t>((0.1 / grid.half_x + 1) * 2);
        const auto row =
            static_cast<uint32_t>((1 - static_cast<double>(point.y / plane) / grid.half_y) * 2);
        expected.push_back(grid.clusterIndex(column, row, slice));
    }
    const auto clusters = clustersByLight(assigned(grid, lights), lights.lights.size());
    for (size_t i = 0; i < expected.size(); ++i) {
        ASSERT_TRUE(std::binary_search(clusters[i].begin(), clusters[i].end(), expected[i])) << i;
    }
}

// Does a box around the cell, in view space, meet the ball? What a plain assigner tests.
bool boxMeets(const Cell& cell, const Ball& ball) {
    const auto away = [](double value, double low, double high) {
        return std::max({0.0, low - value, value - high});
    };
    const double x = away(ball.x, std::min(cell.x0 * cell.z0, cell.x0 * cell.z1),
                          std::max(cell.x1 * cell.z0, cell.x1 * cell.z1));
    const double y = away(ball.y, std::min(cell.y0 * cell.z0, cell.y0 * cell.z1),
                          std::max(cell.y1 * cell.z0, cell.y1 * cell.z1));
    const double z = away(ball.z, cell.z0, cell.z1);
    return x * x + y * y + z * z <= ball.radius * ball.radius;
}

// An entry is in vain if none of a lattice of points of the cell is lit: a cell may be met between
// the points, so a share above 0 is expected even of exact lists.
bool anyPointLit(const Cell& cell, const Ball& ball) {
    constexpr int kSteps = 8;
    for (int i = 0; i <= kSteps; ++i) {
        const double z = cell.z0 + (cell.z1 - cell.z0) * i / kSteps;
        for (int j = 0; j <= kSteps; ++j) {
            const double y = (cell.y0 + (cell.y1 - cell.y0) * j / kSteps) * z - ball.y;
            for (int k = 0; k <= kSteps; ++k) {
                const double x = (cell.x0 + (cell.x1 - cell.x0) * k / kSteps) * z - ball.x;
                if (x * x + y * y + (z - ball.z) * (z - ball.z) < ball.radius * ball.radius) {
                    return true;
                }
            }
        }
    }
    return false;
}

TEST(AssignTightness, EntriesInVain_AreFew) {
    const ClusterGrid grid = makeClusterGrid({16, 9, 24}, {1280, 720}, perspective(45), 0.5, 20);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    light::FrameLights lights;
    for (int i = 0; i < 300; ++i) {
        addPoint(lights, {8 * unit(random), 5 * unit(random), -10 + 10 * unit(random)}, 2);
    }
    const auto clusters = clustersByLight(assigned(grid, lights), lights.lights.size());
    size_t entries = 0;
    size_t in_vain = 0;
    size_t box_entries = 0;
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const Ball ball = ballOf(lights, i);
        entries += clusters[i].size();
        for (uint32_t cluster = 0; cluster < grid.clusterCount(); ++cluster) {
            const Cell cell = grid.cell(cluster % 16, cluster / 16 % 9, cluster / (16 * 9));
            const bool listed = std::binary_search(clusters[i].begin(), clusters[i].end(), cluster);
            in_vain += listed && !anyPointLit(cell, ball) ? 1U : 0U;
            box_entries += boxMeets(cell, ball) ? 1U : 0U;
        }
    }
    const double share = static_cast<double>(in_vain) / static_cast<double>(entries);
    const double box_ratio = static_cast<double>(box_entries) / static_cast<double>(entries);
    RecordProperty("in_vain_percent", std::to_string(share * 100));
    RecordProperty("box_entries_over_entries", std::to_string(box_ratio));
    EXPECT_LT(share, 0.01);
    EXPECT_GT(box_ratio, 1.05);
}

} // namespace
} // namespace froxel::cluster::testing
