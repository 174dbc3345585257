// Where lights are: about the eye, behind it, on planes of the grid, on surfaces, far out.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"

#include <cmath>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardLightPlaces : public SharedGpuTest {};

// Largest error of a lambert picture through fp32, for lights no nearer to a surface than a share
// `near_share` of the surface's distance from the eye. A position is off by at most 4 * 2^-24 of
// that distance (depth, ray, product, difference: half an ulp each); d^2 in the falloff and the
// cosine then by three times that over the share, and the window's square by twice as much again
// where it is steep. Some 20 roundings more belong to the formulas.
double lambertBound(double near_share) {
    return (4 * 7 / near_share + 20) * 0x1p-24;
}

} // namespace

// Case 1. The eye in five-metre lights, off their centres by nothing, 1 mm and the near plane.
TEST_F(HardLightPlaces, EyeInsideLights_ListsLackNothing) {
    auto maker = insideOfABox(4);
    for (const double offset : {0.0, 1e-3, -1e-3, 0.05, -0.05}) {
        for (int axis = 0; axis < 3; ++axis) {
            dvec3 position(0);
            position[axis] = offset;
            maker.point(position, 5);
        }
    }
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    const auto reference = refer(renderer, maker.scene, inputs);
    expectNoneMissing(maker.scene, inputs, reference.visibility);
    EXPECT_GT(litPixels(pictures.naive), 64U * 36U / 2U);
    const auto worst = worstOf(pictures.naive, reference, within(lambertBound(0.5), 1e-7));
    EXPECT_LE(worst.ratio, 1) << worst;
}

// Case 2. Spheres about the wall ahead whose centres are 1 m behind the eye.
TEST_F(HardLightPlaces, CentreBehindRimAhead_LightsWhatItReaches) {
    auto maker = wallAhead(0.3F);
    for (double x = -2; x <= 2; x += 0.25) {
        maker.point({x, x / 4, 1}, 1.5F);
    }
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    const auto reference = refer(renderer, maker.scene, inputs);
    expectNoneMissing(maker.scene, inputs, reference.visibility);
    EXPECT_GT(litPixels(pictures.naive), 64U * 36U / 2U);
}

// Case 3. It reaches nothing that the eye could see.
TEST_F(HardLightPlaces, WhollyBehind_IsInNoListAndAddsNothing) {
    auto maker = wallAhead(0.1F);
    maker.point({0, 0, 2}, 1.9F).point({5, 0, 2}, 1.9F).point({0, 0, 1e6}, 100);
    render::Renderer renderer(device(), maker.scene);
    const auto pictures = expectExact(renderer, hardInputs());
    EXPECT_EQ(pictures.forward_plus.stats.lists.entry_count, 0U);
    EXPECT_EQ(litPixels(pictures.naive), 0U);
}

// Case 4. Spheres that touch the planes of clusters to the last bits, where a surface is: the wall
// is behind the planes, so that rims lie on it and about it.
TEST_F(HardLightPlaces, TangentToPlanes_ListsLackNothing) {
    auto maker = wallAhead(4);
    const double half_y = std::tan(glm::radians(30.0));
    const double half_x = half_y * 64 / 36;
    for (const int column : {-7, -3, 0, 4, 7}) {
        const double edge_x = half_x * column / 8;  // of 16 columns
        const double edge_y = half_y * column / 18; // and 18 half rows
        const dvec3 inside(edge_x * 4 + 0.25, edge_y * 4 + 0.125, -3.75);
        const double distances[] = {(inside.x + edge_x * inside.z) / std::hypot(1.0, edge_x),
                                    (inside.y + edge_y * inside.z) / std::hypot(1.0, edge_y),
                                    glm::length(inside), -inside.z - 0.05, 4 + inside.z};
        for (const double distance : distances) {
            const auto radius = static_cast<float>(std::abs(distance));
            for (const int ulps : {-8, -1, 0, 1, 8}) {
                maker.point(inside, radius * (1 + static_cast<float>(ulps) * 0x1p-23F));
            }
        }
    }
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    (void)expectExact(renderer, inputs);
    expectNoneMissing(maker.scene, inputs, refer(renderer, maker.scene, inputs).visibility);
}

// Case 5. Far off the axis a sphere's picture is much wider than its radius over its depth.
TEST_F(HardLightPlaces, OffAxisWideFieldOfView_ListsLackNothing) {
    auto maker = insideOfABox(6);
    for (double degrees = -58; degrees <= 58; degrees += 4) {
        const double angle = glm::radians(degrees);
        maker.point({5 * std::sin(angle), degrees / 30, -5 * std::cos(angle)}, 2);
    }
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.camera.yfov_rad = glm::radians(120.0);
    const auto pictures = expectExact(renderer, inputs);
    expectNoneMissing(maker.scene, inputs, refer(renderer, maker.scene, inputs).visibility);
    EXPECT_GT(litPixels(pictures.naive), 0U);
}

// Case 12. Above a pixel's own point, at heights down to none. The wall is at a power of two and
// the heights are powers of two, so that they are exact; below a float's step of 2 m nothing is
// left of them. What remains is the rounding across the wall: 2 * 2^-23 of the 1 cm where falloff
// ends.
TEST_F(HardLightPlaces, OnASurface_IsFiniteAndAsDoublePrecisionHasIt) {
    const double px = 2 * std::tan(glm::radians(30.0)) / 36 * 2; // on the wall 2 m away
    for (const double height : {0.0, 0x1p-26, 0x1p-13, 0x1p-7}) {
        SCOPED_TRACE(height);
        auto maker = wallAhead(2);
        maker.point({0.5 * px, 0.5 * px, -2 + height}, 1);
        render::Renderer renderer(device(), maker.scene);
        auto inputs = hardInputs();
        inputs.settings.camera.near_m = 0x1p-4;
        const auto pictures = expectExact(renderer, inputs);
        if (height < 0x1p-24) {
            EXPECT_EQ(largest(pictures.naive), 0.0F);
            continue;
        }
        EXPECT_GT(largest(pictures.naive), 0.24F * 1e4F / 3.1416F); // the light is a quarter red
        const auto reference = refer(renderer, maker.scene, inputs);
        const auto worst = worstOf(pictures.naive, reference, within(1e-4, 1e-6));
        EXPECT_LE(worst.ratio, 1) << worst;
    }
}

// Case 22. A slanted floor and its lights, moved by distances that doubles hold but floats do not.
TEST_F(HardLightPlaces, WorldFarFromTheOrigin_LooksTheSame) {
    const auto floorAt = [](const dvec3& away) {
        SceneMaker maker;
        glm::dmat4 world(1);
        world[3] = glm::dvec4(away, 1);
        maker.add(quad({-40, -1.5, 2}, {80, 0, 0}, {0, 3, -20}, 8, 0), world);
        for (int i = 0; i < 12; ++i) {
            maker.point(away + dvec3(i - 6, 0.25 * (i % 3), -0.5 - 0.1 * (i % 4)), 3);
        }
        return maker.scene;
    };
    const auto near_scene = floorAt({0, 0, 0});
    render::Renderer near_renderer(device(), near_scene);
    const auto inputs = hardInputs();
    const auto near_picture = expectExact(near_renderer, inputs, Toon::kNo).naive;
    EXPECT_GT(litPixels(near_picture), 700U);
    for (const double distance : {1e3, 1e4, 1e6, 1e7}) {
        SCOPED_TRACE(distance);
        const dvec3 away(distance, -distance / 3, distance / 7);
        const auto scene = floorAt(away);
        render::Renderer renderer(device(), scene);
        auto moved = inputs;
        moved.settings.camera.eye_world = away;
        const auto picture = expectExact(renderer, moved, Toon::kNo).naive;
        double worst = 0;
        for (size_t i = 0; i < picture.radiance.size(); ++i) {
            const auto a = static_cast<double>(near_picture.radiance[i]);
            const auto b = static_cast<double>(picture.radiance[i]);
            worst = std::max(worst, std::abs(a - b) / (std::abs(a) + 1e-6));
        }
        EXPECT_LE(worst, 1e-4);
    }
}

} // namespace froxel::test
