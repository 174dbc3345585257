// Random lights, grids and cameras against the oracle: nothing missing, nothing too many.
#include "assign_cases.h"

#include <ostream>

namespace froxel::cluster::testing {
namespace {

struct Shape {
    const char* name;
    settings::GridSize grid;
    settings::Size image;
    settings::Camera camera;
    double near_m;
    double far_m;
    settings::GridLaw law = settings::GridLaw::kLogarithmic;
};

void PrintTo(const Shape& shape, std::ostream* out) {
    *out << shape.name;
}

class AssignRandom : public ::testing::TestWithParam<Shape> {};

light::FrameLights randomLights(std::mt19937& random, double far_m, double half_extent, int count) {
    std::uniform_real_distribution<double> unit(0, 1);
    light::FrameLights lights;
    for (int i = 0; i < count; ++i) {
        const double depth = far_m * (1.5 * std::pow(unit(random), 2) - 0.25);
        const double side = (std::abs(depth) + 0.1 * far_m) * half_extent * 1.5;
        const double radius = far_m * std::pow(10.0, -4.0 + 4.3 * unit(random));
        addPoint(lights, {(2 * unit(random) - 1) * side, (2 * unit(random) - 1) * side, -depth},
                 radius);
    }
    return lights;
}

TEST_P(AssignRandom, Lights_MeetExactlyTheClustersOfTheOracle) {
    const Shape& shape = GetParam();
    const ClusterGrid grid = makeClusterGrid({shape.grid, shape.law}, shape.image, shape.camera,
                                             shape.near_m, shape.far_m);
    const bool flat = shape.camera.projection == settings::Projection::kOrthographic;
    const double extent = flat ? grid.half_x / shape.far_m : grid.half_x;
    std::mt19937 random(7);
    expectExact(grid, randomLights(random, shape.far_m, extent, 600));
}

settings::Camera shifted(settings::Camera camera, double x, double y) {
    camera.lens_shift = {x, y};
    return camera;
}

constexpr auto kLinear = settings::GridLaw::kLinear;
constexpr auto kHyperbolic = settings::GridLaw::kHyperbolic;

INSTANTIATE_TEST_SUITE_P(
    Shapes,
    AssignRandom,
    ::testing::Values(
        Shape{"usual", {16, 9, 24}, {1280, 720}, perspective(45), 0.1, 30},
        Shape{"wide", {16, 9, 24}, {1919, 1079}, perspective(120), 0.1, 100},
        Shape{"widest", {15, 15, 15}, {640, 640}, perspective(170), 0.01, 10},
        Shape{"narrow", {8, 8, 8}, {333, 777}, perspective(1), 1, 1000},
        Shape{"odd", {16, 9, 24}, {17, 33}, perspective(60), 0.05, 20},
        Shape{"column", {16, 9, 4}, {1, 97}, perspective(60), 0.05, 20},
        Shape{"pixel", {16, 16, 24}, {1, 1}, perspective(60), 0.05, 20},
        Shape{"one", {1, 1, 1}, {1280, 720}, perspective(45), 0.1, 30},
        Shape{"one_slice", {16, 9, 1}, {1280, 720}, perspective(45), 0.1, 30},
        Shape{"one_tile", {1, 1, 24}, {1280, 720}, perspective(45), 0.1, 30},
        Shape{"near_is_far", {4, 4, 8}, {640, 360}, perspective(45), 10, 10},
        Shape{"deep", {4, 4, 64}, {640, 360}, perspective(45), 1e-3, 1e5},
        Shape{"linear", {16, 9, 24}, {1280, 720}, perspective(45), 0.1, 30, kLinear},
        Shape{"hyperbolic", {16, 9, 24}, {1280, 720}, perspective(45), 0.1, 30, kHyperbolic},
        Shape{"shifted", {16, 9, 24}, {1280, 720}, shifted(perspective(60), 0.5, -0.3), 0.1, 30},
        Shape{"axis_outside", {9, 9, 9}, {640, 480}, shifted(perspective(40), -2.5, 1.7), 0.1, 30},
        Shape{"far_off", {9, 9, 9}, {640, 480}, shifted(perspective(20), 30, 0), 0.1, 30},
        Shape{"shifted_linear",
              {7, 5, 11},
              {333, 777},
              shifted(perspective(90), 0.2, 1.1),
              0.1,
              30,
              kLinear},
        Shape{"orthographic_shifted",
              {9, 9, 5},
              {641, 480},
              shifted(orthographic(5), 1.5, -3),
              0.1,
              30},
        Shape{"orthographic", {16, 9, 24}, {1280, 720}, orthographic(8), 0.1, 30},
        Shape{"orthographic_odd", {16, 9, 3}, {1919, 1079}, orthographic(0.5), 0.1, 2}));

} // namespace
} // namespace froxel::cluster::testing
