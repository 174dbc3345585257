#include "builtin_scene/cameras.h"

#include "settings/camera.h"

#include <array>

namespace froxel::builtin_scene {
namespace {

struct View {
    const char* name;
    glm::dvec3 eye, target;
    double yfov_deg;
};

constexpr std::array<View, 6> kViews = {
    View{"Nave", {-14.6, 2.3, 0.0}, {0.0, 4.6, 0.0}, 62},
    View{"Gallery", {-10.1, 7.7, 3.3}, {6.0, 3.4, -2.6}, 62},
    View{"Arcade", {-14.4, 1.7, -5.6}, {2.0, 2.3, -5.0}, 60},
    View{"Garden", {6.3, 1.65, -0.3}, {9.5, 2.2, -7.0}, 58},
    View{"Detail", {-9.8, 2.4, -2.0}, {-6.3, 2.65, -4.6}, 48},
    View{"Glass", {-12.1, 1.55, 5.75}, {-13.7, 1.07, 6.28}, 46},
};

} // namespace

void addCameras(scene::Scene& scene) {
    for (const View& view : kViews) {
        settings::Camera camera = settings::lookAt(view.eye, view.target, {0, 1, 0});
        camera.yfov_rad = glm::radians(view.yfov_deg);
        scene.cameras.push_back({view.name, camera});
    }
}

void addLights(scene::Scene& scene) {
    scene::PunctualLight moon;
    moon.name = "Moonlight";
    moon.type = scene::LightType::kDirectional;
    moon.direction_world = glm::normalize(glm::dvec3(0.25, -1.0, 0.35));
    moon.color = {0.62F, 0.75F, 1.0F};
    moon.intensity = 0.12F;
    scene.lights.push_back(moon);

    // The four lanterns about the fountain.
    for (const double x : {-2.25, 2.25}) {
        for (const double z : {-2.35, 2.35}) {
            scene::PunctualLight lantern;
            lantern.name = "Lantern";
            lantern.position_world = {x, 5.6, z};
            lantern.color = {1.0F, 0.62F, 0.28F};
            lantern.intensity = 5.0F;
            lantern.range_m = 5.0F;
            scene.lights.push_back(lantern);
        }
    }

    scene::PunctualLight altar;
    altar.name = "Apse";
    altar.type = scene::LightType::kSpot;
    altar.position_world = {14.6, 5.6, 0.0};
    altar.direction_world = glm::normalize(glm::dvec3(1.0, -0.25, 0.0));
    altar.color = {1.0F, 0.78F, 0.50F};
    altar.intensity = 26.0F;
    altar.range_m = 9.0F;
    altar.inner_cone_rad = 0.55;
    altar.outer_cone_rad = 0.95;
    scene.lights.push_back(altar);
}

} // namespace froxel::builtin_scene
