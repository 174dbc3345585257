// What the automatic grid would gain from knowing at which depths the picture's pixels lie, instead
// of taking any depth alike: frames of both choices in turns, and of a fixed grid. grid_depths
// [SCENE.gltf|hall] [LIGHTS [RADIUS_M [WIDTH HEIGHT]]]; on a GPU where there is one.
#include "builtin_scene/hall.h"
#include "cluster/grid_choice.h"
#include "gltf/gltf_loader.h"
#include "light/light_rig.h"
#include "reference/geometry.h"
#include "render/view/renderer.h"
#include "render/view/visibility_readback.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace froxel;

constexpr int kFrames = 40;
constexpr size_t kDepths = 64;

// As many evenly drawn from all pixels, by depth.
std::vector<double> depthsOf(const scene::Scene& scene,
                             const Visibility& visibility,
                             const settings::ViewSettings& settings) {
    const reference::PixelRays rays(settings.camera, settings.size);
    std::vector<double> all;
    for (uint32_t y = 0; y < visibility.height_px; y += 4) {
        for (uint32_t x = 0; x < visibility.width_px; x += 4) {
            const auto& pixel = visibility.pixels[size_t{y} * visibility.width_px + x];
            if (pixel.instance == VisibleTriangle::kNothing) {
                continue;
            }
            const auto& instance = scene.instances[pixel.instance];
            const auto& primitive = scene.meshes[instance.mesh].primitives[pixel.primitive];
            const reference::Placement placement(instance, settings.camera.eye_world);
            all.push_back(
                meetPlane(rays.through(x, y), placedTriangle(placement, primitive, pixel.triangle))
                    .distance);
        }
    }
    std::sort(all.begin(), all.end());
    std::vector<double> some;
    for (size_t i = 0; i < kDepths && !all.empty(); ++i) {
        some.push_back(all[(2 * i + 1) * all.size() / (2 * kDepths)]);
    }
    return some;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Variant {
    const char* name;
    settings::GridSize size;
    render::ViewRenderer view;
    std::vector<double> frame_us = {};
};

struct Asked {
    uint32_t light_count = 1000;
    float radius_m = 2;
    settings::Size size{1280, 720};
};

void run(render::Renderer& renderer,
         const scene::Scene& scene,
         const settings::Camera& camera,
         bool is_cpu,
         const Asked& asked) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = asked.size;
    inputs.settings.lights.count = asked.light_count;
    inputs.settings.lights.radius_m = asked.radius_m;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    const auto seen = render::readVisibility(renderer, scene, inputs).value();
    const auto depths = depthsOf(scene, seen, inputs.settings);
    const light::LightRig rig(scene);
    light::FrameLights lights;
    rig.evaluate(inputs.settings.lights, camera, 0, lights);
    const auto range = cluster::litDepthRange(lights, camera, scene.bounds_world);
    const auto frustum = cluster::makeClusterGrid({.size = {1, 1, 1}}, asked.size, camera,
                                                  range.near_m, range.far_m);
    const auto spread = cluster::lightSpread(frustum, lights);
    cluster::GridFacts facts{.frustum = frustum,
                             .range = range,
                             .lights = spread,
                             .costs = is_cpu ? cluster::kCpuCosts : cluster::kGpuCosts};
    const auto blind = cluster::chooseGrid(facts, {});
    std::vector<double> evenly;
    for (size_t i = 0; i < kDepths; ++i) {
        evenly.push_back(range.far_m * (static_cast<double>(i) + 0.5) / kDepths);
    }
    facts.pixel_depths_m = evenly;
    const auto even = cluster::chooseGrid(facts, {});
    facts.pixel_depths_m = depths;
    const auto seeing = cluster::chooseGrid(facts, {});
    std::array variants = {
        Variant{"mostly near", blind.shape.size, render::ViewRenderer(renderer)},
        Variant{"pixels' depths", seeing.shape.size, render::ViewRenderer(renderer)},
        Variant{"any depth alike", even.shape.size, render::ViewRenderer(renderer)},
        Variant{"16x9x24", {16, 9, 24}, render::ViewRenderer(renderer)},
        Variant{"mostly near again", blind.shape.size, render::ViewRenderer(renderer)}};
    for (int i = -4; i < kFrames; ++i) {
        for (auto& variant : variants) {
            inputs.settings.grid = {.automatic = false, .size = variant.size};
            inputs.time_s = 0.03 * i;
            variant.view.submit(inputs).value();
            const auto frame = variant.view.collect();
            const double us = is_cpu ? frame->stats.frame_us : frame->stats.gpu_us.value();
            if (i >= 0) {
                variant.frame_us.push_back(us);
            }
        }
    }
    std::printf("range %.2f to %.2f m, pixels at %.2f / %.2f / %.2f m\n", range.near_m, range.far_m,
                depths.front(), depths[kDepths / 2], depths.back());
    const double base = median(variants[0].frame_us);
    for (const auto& variant : variants) {
        const double us = median(variant.frame_us);
        std::printf("  %-16s %3u x %2u x %2u  %9.0f us  %.3f\n", variant.name, variant.size.x,
                    variant.size.y, variant.size.z, us, us / base);
    }
}

} // namespace

int main(int argc, char** argv) try {
    const std::string path = argc > 1 ? argv[1] : "hall";
    Asked asked;
    asked.light_count = argc > 2 ? static_cast<uint32_t>(std::stoul(argv[2])) : 1000;
    asked.radius_m = argc > 3 ? std::stof(argv[3]) : 2;
    if (argc > 5) {
        asked.size = {static_cast<uint32_t>(std::stoul(argv[4])),
                      static_cast<uint32_t>(std::stoul(argv[5]))};
    }
    gpu::Device device({});
    const auto scene = path == "hall" ? builtin_scene::makeHall() : gltf::load(path).value();
    render::Renderer renderer(device, scene);
    std::printf("%s, %ux%u, %u lights of %g m\n", scene.name.c_str(), asked.size.width_px,
                asked.size.height_px, asked.light_count, static_cast<double>(asked.radius_m));
    std::vector<settings::Camera> cameras;
    for (const auto& camera : scene.cameras) {
        cameras.push_back(camera.camera);
    }
    if (path != "hall") {
        cameras.push_back(settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0}));
    }
    for (const auto& camera : cameras) {
        run(renderer, scene, camera, device.traits().is_cpu, asked);
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "grid_depths: %s\n", error.what());
    return 1;
}
