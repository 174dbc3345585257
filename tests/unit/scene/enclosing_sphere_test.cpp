#include "scene/enclosing_sphere.h"
#include "scene/first_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace froxel::scene {
namespace {

// Points of a ball, placed many times over, turned and stretched; bounds as the loader makes them:
// of the corners of each mesh's box.
Scene makeCrowd(uint32_t instance_count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> in(-1, 1);
    Primitive ball;
    while (ball.positions.size() < 300) {
        const glm::vec3 point(in(random), in(random), in(random));
        if (glm::length(point) <= 1) {
            ball.positions.push_back(point);
            ball.bounds.add(point);
        }
    }
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {{"ball", {ball}}};
    for (uint32_t i = 0; i < instance_count; ++i) {
        glm::dmat4 place(1);
        for (int column = 0; column < 3; ++column) {
            place[column] = {in(random), in(random), in(random), 0};
        }
        place[3] = {9 * in(random), 2 * in(random), 5 * in(random), 1};
        scene.instances.push_back({0, place, ""});
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec3 of_box((corner & 1U) != 0 ? ball.bounds.max.x : ball.bounds.min.x,
                                    (corner & 2U) != 0 ? ball.bounds.max.y : ball.bounds.min.y,
                                    (corner & 4U) != 0 ? ball.bounds.max.z : ball.bounds.min.z);
            scene.bounds_world.add(glm::dvec3(place * glm::dvec4(of_box, 1)));
        }
    }
    return scene;
}

template <class Visit>
void eachVertex(const Scene& scene, const Visit& visit) {
    for (const Instance& instance : scene.instances) {
        for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            for (const glm::vec3& position : primitive.positions) {
                visit(glm::dvec3(instance.world_from_object * glm::dvec4(position, 1)));
            }
        }
    }
}

TEST(EnclosingSphere, OfManyInstances_GoesThroughTheFarthestVertex) {
    for (const uint32_t count : {1U, 2U, 40U}) {
        const Scene scene = makeCrowd(count);
        const settings::Sphere sphere = enclosingSphere(scene);
        EXPECT_EQ(sphere.center, scene.bounds_world.center());
        double farthest = 0;
        eachVertex(scene, [&](const glm::dvec3& world) {
            farthest = std::max(farthest, glm::distance(world, sphere.center));
        });
        EXPECT_EQ(sphere.radius_m, farthest);
        EXPECT_LT(sphere.radius_m, glm::length(scene.bounds_world.size()) / 2);
    }
}

TEST(EnclosingSphere, OfNothing_IsTheUsualOne) {
    EXPECT_EQ(enclosingSphere(Scene{}).radius_m, settings::Sphere{}.radius_m);
}

// Portrait and landscape.
TEST(FirstView, OfASceneWithoutCameras_HasEveryVertexInThePicture) {
    const Scene scene = makeCrowd(12);
    for (const settings::Size size :
         {settings::Size{360, 640}, {1000, 1000}, {1280, 720}, {64, 1024}}) {
        const settings::Camera camera = firstViewOf(scene, enclosingSphere(scene)).cameraFor(size);
        const double half = std::tan(camera.yfov_rad / 2);
        const double aspect = static_cast<double>(size.width_px) / size.height_px;
        eachVertex(scene, [&](const glm::dvec3& world) {
            const glm::dvec3 at =
                glm::transpose(camera.world_from_view) * (world - camera.eye_world);
            ASSERT_LT(at.z, -camera.near_m);
            EXPECT_LT(std::abs(at.x), -at.z * half * aspect) << size.width_px;
            EXPECT_LT(std::abs(at.y), -at.z * half) << size.height_px;
        });
    }
}

} // namespace
} // namespace froxel::scene
