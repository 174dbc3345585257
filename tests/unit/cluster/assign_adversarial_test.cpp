// Thousands of configurations drawn from what breaks assignment: every law and projection, lenses
// shifted out of the picture, grids from one cluster up, pictures from one pixel up, balls that
// touch planes to the last bits, radii over seven decades, the eye on and in lights.
#include "assign_cases.h"

#include <cmath>

namespace froxel::cluster::testing {
namespace {

class Draw {
  public:
    explicit Draw(unsigned seed) : random_(seed) {}

    [[nodiscard]] double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    [[nodiscard]] double decades(double low, double high) {
        return std::pow(10.0, between(std::log10(low), std::log10(high)));
    }
    template <class T>
    [[nodiscard]] T oneOf(std::initializer_list<T> values) {
        return values.begin()[random_() % values.size()];
    }

  private:
    std::mt19937 random_;
};

settings::Camera randomCamera(Draw& draw) {
    settings::Camera camera = draw.between(0, 1) < 0.3 ? orthographic(draw.decades(0.01, 1000))
                                                       : perspective(draw.between(1, 170));
    if (draw.between(0, 1) < 0.5) {
        camera.lens_shift = {draw.between(-3, 3), draw.between(-3, 3)};
    }
    return camera;
}

ClusterGrid randomGrid(Draw& draw) {
    const GridShape shape{
        .size = {draw.oneOf({1U, 2U, 5U, 13U}), draw.oneOf({1U, 2U, 7U, 9U}),
                 draw.oneOf({1U, 2U, 6U, 24U})},
        .law = draw.oneOf({settings::GridLaw::kLogarithmic, settings::GridLaw::kLinear,
                           settings::GridLaw::kHyperbolic})};
    const settings::Size image{draw.oneOf({1U, 17U, 640U, 1919U}),
                               draw.oneOf({1U, 33U, 360U, 1079U})};
    const double near_m = draw.decades(1e-3, 100);
    return makeClusterGrid(shape, image, randomCamera(draw), near_m, near_m * draw.decades(1, 1e5));
}

// A point in or about the grid: of a random cell, moved out by up to a cell.
glm::dvec3 randomPoint(Draw& draw, const ClusterGrid& grid) {
    const auto index = [&](uint32_t count) {
        return static_cast<uint32_t>(draw.between(0, count - 1e-9));
    };
    const Cell cell =
        grid.cell(index(grid.usedColumns()), index(grid.usedRows()), index(grid.size.z));
    const auto along = [&](double low, double high) {
        return low + (high - low) * draw.between(-0.7, 1.7);
    };
    const double z = along(cell.z0, cell.z1);
    const double scale = grid.projection == settings::Projection::kPerspective ? z : 1.0;
    return {along(cell.x0, cell.x1) * scale, along(cell.y0, cell.y1) * scale, z};
}

float ulpsAway(float value, int ulps) {
    for (int i = 0; i < std::abs(ulps); ++i) {
        value = std::nextafter(value, ulps < 0 ? 0.0F : kUnlimited);
    }
    return value;
}

// The distance from a point to one of the planes that bound a cell.
double planeDistance(Draw& draw, const ClusterGrid& grid, const glm::dvec3& p) {
    const auto index = [&](uint32_t count) {
        return static_cast<uint32_t>(draw.between(0, count + 1 - 1e-9));
    };
    const bool perspective = grid.projection == settings::Projection::kPerspective;
    const auto side = [&](double value, double edge) {
        return perspective ? std::abs(value - edge * p.z) / std::sqrt(1 + edge * edge)
                           : std::abs(value - edge);
    };
    switch (draw.oneOf({0, 1, 2})) {
    case 0:
        return side(p.x, grid.columnEdge(index(grid.usedColumns())));
    case 1:
        return side(p.y, grid.rowEdge(index(grid.usedRows())));
    default:
        return std::abs(p.z - static_cast<double>(grid.plane_depths_m[index(grid.size.z)]));
    }
}

void addTouching(Draw& draw, const ClusterGrid& grid, light::FrameLights& lights) {
    const glm::dvec3 exact = randomPoint(draw, grid);
    const glm::dvec3 rounded(glm::vec3(exact.x, exact.y, exact.z));
    const auto distance = static_cast<float>(planeDistance(draw, grid, rounded));
    addPoint(lights, {rounded.x, -rounded.y, -rounded.z},
             static_cast<double>(ulpsAway(distance, draw.oneOf({-3, -1, 0, 1, 3}))));
}

class AssignAdversarial : public ::testing::TestWithParam<unsigned> {};

TEST_P(AssignAdversarial, Points_MeetExactlyTheClustersOfTheOracle) {
    Draw draw(GetParam());
    for (int configuration = 0; configuration < 300; ++configuration) {
        const ClusterGrid grid = randomGrid(draw);
        light::FrameLights lights;
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 p = randomPoint(draw, grid);
            addPoint(lights, {p.x, -p.y, -p.z}, draw.decades(1e-3, 1e4));
            addTouching(draw, grid, lights);
        }
        const double eye = draw.decades(1e-3, 1e4);
        addPoint(lights, {0, 0, 0}, eye);
        addPoint(lights, glm::normalize(randomPoint(draw, grid) + 1e-12) * eye,
                 eye * (1 + draw.oneOf({-1e-7, 0.0, 1e-7})));
        SCOPED_TRACE("configuration " + std::to_string(configuration));
        expectExact(grid, lights);
        if (HasFatalFailure()) {
            return;
        }
    }
}

TEST_P(AssignAdversarial, Spots_MissNoLitCell) {
    Draw draw(GetParam() + 1000);
    for (int configuration = 0; configuration < 40; ++configuration) {
        const ClusterGrid grid = randomGrid(draw);
        light::FrameLights lights;
        for (const double half_angle_deg : {0.01, 0.5, 10.0, 44.9, 45.1, 79.9, 80.1, 90.0, 179.9}) {
            const glm::dvec3 p = randomPoint(draw, grid);
            const glm::dvec3 toward = randomPoint(draw, grid) - p;
            addSpot(lights, {p.x, -p.y, -p.z}, draw.decades(1e-3, 1e4),
                    {toward.x + 1e-12, -toward.y, -toward.z}, half_angle_deg);
        }
        const auto clusters = clustersByLight(assigned(grid, lights), lights.lights.size());
        for (size_t i = 0; i < lights.lights.size(); ++i) {
            const Ball ball = ballOf(lights, i);
            const glm::dvec3 apex(ball.x, ball.y, ball.z);
            const glm::dvec3 way(lights.spots[i].direction_view);
            const glm::dvec3 axis = glm::normalize(glm::dvec3(way.x, -way.y, -way.z));
            for (const uint32_t cluster : reference::clustersOf(grid, ball)) {
                if (std::binary_search(clusters[i].begin(), clusters[i].end(), cluster)) {
                    continue;
                }
                const Cell cell =
                    grid.cell(cluster % grid.size.x, cluster / grid.size.x % grid.size.y,
                              cluster / (grid.size.x * grid.size.y));
                ASSERT_LT(reference::largestCosine(apex, axis, ball.radius, cell, grid.projection),
                          lights.cones[i].cos_outer)
                    << "configuration " << configuration << ", spot " << i;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, AssignAdversarial, ::testing::Range(1U, 9U));

} // namespace
} // namespace froxel::cluster::testing
