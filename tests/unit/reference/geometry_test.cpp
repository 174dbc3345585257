// The reference's rays, triangles and placements against closed forms.
#include "reference/geometry.h"
#include "reference/rays.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::reference {
namespace {

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double bound) {
    EXPECT_LE(glm::length(a - b), bound) << a.x << " " << a.y << " " << a.z;
}

scene::Primitive rightTriangle() {
    scene::Primitive p;
    p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    p.normals.assign(3, {0, 0, 1});
    p.uv0 = {{0, 0}, {2, 0}, {0, 4}};
    p.indices = {0, 1, 2};
    return p;
}

scene::Instance placed(const glm::dvec3& at, const glm::dvec3& scale) {
    scene::Instance instance;
    for (int i = 0; i < 3; ++i) {
        instance.world_from_object[i][i] = scale[i];
    }
    instance.world_from_object[3] = glm::dvec4(at, 1);
    return instance;
}

TEST(ReferenceRays, CornersOfAPicture_LieOnTheFrustum) {
    settings::Camera camera;
    camera.yfov_rad = 2 * std::atan(0.5);
    const PixelRays rays(camera, {4, 2});
    expectNear(rays.through(0, 0).direction, {-0.75, 0.25, -1}, 1e-15);
    expectNear(rays.through(3, 1).direction, {0.75, -0.25, -1}, 1e-15);
    camera.lens_shift = {1, 0}; // the axis meets the left edge
    expectNear(PixelRays(camera, {4, 2}).through(0, 0).direction, {0.25, 0.25, -1}, 1e-15);
    camera.projection = settings::Projection::kOrthographic;
    camera.half_height_m = 3;
    const Ray ray = PixelRays(camera, {4, 2}).through(0, 0);
    expectNear(ray.origin, {1.5, 1.5, 0}, 1e-15);
    expectNear(ray.direction, {0, 0, -1}, 0);
}

TEST(ReferenceRays, ProjectedPoint_IsThePixelThatItsRayGoesThrough) {
    settings::Camera camera = settings::lookAt({1, 2, 3}, {4, 0, -2}, {0, 1, 0});
    camera.lens_shift = {0.3, -0.6};
    for (const auto kind :
         {settings::Projection::kPerspective, settings::Projection::kOrthographic}) {
        camera.projection = kind;
        const PixelRays rays(camera, {320, 200});
        const Ray ray = rays.through(37, 150);
        double along = 0;
        const glm::dvec2 at = rays.project(ray.origin + ray.direction * 7.0, along);
        EXPECT_NEAR(at.x, 37.5, 1e-10);
        EXPECT_NEAR(at.y, 150.5, 1e-10);
        EXPECT_NEAR(along, 7, 1e-12);
    }
}

TEST(ReferenceRays, RayMeetsAPlane_AtItsWeights) {
    const Triangle t{{1, 2, -5}, {2, 0, 1}, {0, 3, 1}};
    for (const glm::dvec2 w : {glm::dvec2(0.2, 0.3), glm::dvec2(0, 0), glm::dvec2(1.5, -2)}) {
        const glm::dvec3 point = t.corner + t.edge1 * w.x + t.edge2 * w.y;
        const PlanePoint met = meetPlane({glm::dvec3(0), point / 8.0}, t);
        ASSERT_TRUE(met.met);
        EXPECT_NEAR(met.distance, 8, 1e-13);
        EXPECT_NEAR(met.weights.x, w.x, 1e-13);
        EXPECT_NEAR(met.weights.y, w.y, 1e-13);
        EXPECT_EQ(met.inside(), w.x >= 0 && w.x < 1);
    }
    EXPECT_FALSE(meetPlane({glm::dvec3(0), {1, 0, 0}}, {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}).met);
}

TEST(ReferenceRays, WeightsOutside_AreMovedToTheTriangle) {
    for (const glm::dvec2 w : {glm::dvec2(-0.1, 0.5), glm::dvec2(0.7, 0.6), glm::dvec2(2, -3)}) {
        const glm::dvec2 in = clampToTriangle(w);
        EXPECT_GE(in.x, 0);
        EXPECT_GE(in.y, 0);
        EXPECT_LE(in.x + in.y, 1 + 1e-15);
    }
    EXPECT_EQ(clampToTriangle({0.25, 0.5}), glm::dvec2(0.25, 0.5));
}

// Of a plane z = f(x, y) = x + 2 y under scale (1, -1, 3): z = 3 (x - 2 y), whose normal is known.
TEST(ReferenceGeometry, MirroredAndUnevenlyScaled_NormalsStandOnTheSurface) {
    scene::Primitive p = rightTriangle();
    p.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 2}};
    p.normals.assign(3, glm::normalize(glm::vec3(-1, -2, 1)));
    const Placement placement(placed({0, 0, -9}, {1, -1, 3}), {0, 0, 0});
    settings::Camera camera;
    const PixelRays rays(camera, {64, 64});
    const Triangle t = placedTriangle(placement, p, 0);
    const PixelHit hit{31, 32, meetPlane(rays.through(31, 32), t)};
    const SurfacePoint s = surfaceAt(rays, hit, placement, p, 0);
    expectNear(s.normal, glm::normalize(glm::dvec3(-3, 6, 1)), 1e-7); // the file's normal is fp32
    EXPECT_NEAR(glm::dot(s.normal, t.edge1), 0, 1e-6);
    EXPECT_NEAR(glm::dot(s.normal, t.edge2), 0, 1e-6);
    EXPECT_EQ(placement.side, -1);
    EXPECT_TRUE(s.front); // the eye is on the normal's side, whatever the winding
}

TEST(ReferenceGeometry, FarFromTheOrigin_PointsAreAsNearIt) {
    const scene::Primitive p = rightTriangle();
    settings::Camera camera;
    const PixelRays rays(camera, {64, 64});
    std::array<glm::dvec3, 2> positions;
    for (size_t i = 0; i < 2; ++i) {
        const glm::dvec3 offset = i == 0 ? glm::dvec3(0) : glm::dvec3(1e6, -1e6, 1e6);
        const Placement placement(placed(offset + glm::dvec3(0, 0, -2), glm::dvec3(1)), offset);
        const Triangle t = placedTriangle(placement, p, 0);
        const PixelHit hit{36, 25, meetPlane(rays.through(36, 25), t)};
        positions[i] = surfaceAt(rays, hit, placement, p, 0).position;
    }
    expectNear(positions[0], positions[1], 1e-9);
}

// A floor seen at a slant: the same for all pixels of a block, near the derivatives at each.
TEST(ReferenceGeometry, Gradients_OfAPlane_AreDifferencesInsideTheBlock) {
    scene::Primitive p = rightTriangle();
    p.positions = {{-50, -1, 50}, {50, -1, 50}, {-50, -1, -50}};
    p.normals.assign(3, {0, 1, 0});
    const Placement placement(placed({0, 0, -60}, glm::dvec3(1)), {0, 0, 0});
    const settings::Camera camera;
    const PixelRays rays(camera, {64, 64});
    const Triangle t = placedTriangle(placement, p, 0);
    const auto at = [&](int64_t x, int64_t y) {
        return surfaceAt(rays, {x, y, meetPlane(rays.through(x, y), t)}, placement, p, 0);
    };
    const SurfacePoint first = at(20, 40);
    const SurfacePoint last = at(21, 41);
    EXPECT_EQ(first.weights_dx, at(21, 40).weights_dx);
    EXPECT_EQ(first.weights_dx, at(21, 40).weights - first.weights);
    EXPECT_EQ(last.weights_dy, at(21, 40).weights_dy);
    EXPECT_EQ(last.weights_dy, last.weights - at(21, 40).weights);
    // The same view direction and a neighbour 1e-4 of a pixel away.
    const Ray ray = rays.through(20, 40);
    const Ray down = rays.through(20, 41);
    const double h = 1e-4;
    const Ray near{ray.origin, ray.direction + (down.direction - ray.direction) * h};
    const double derivative = (meetPlane(near, t).weights.y - first.weights.y) / h;
    EXPECT_NEAR(first.weights_dy.y, derivative, 0.2 * std::abs(derivative));
}

} // namespace
} // namespace froxel::reference
