// Ways to the G-buffer and to radiance, timed side by side, and how far their pictures are apart:
// bench_visibility [SCENE.gltf]; the built-in hall without. On a GPU where there is one.
#include "builtin_scene/hall.h"
#include "gltf/gltf_loader.h"
#include "render/view/renderer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace froxel;
using render::GeometryPath;
using settings::LightingStage;
using settings::Renderer;

constexpr uint32_t kWarmup = 10;
constexpr uint32_t kFrames = 60;

struct Way {
    const char* name;
    Renderer renderer;
    LightingStage lighting;
    GeometryPath geometry;
    bool cull = true;
    settings::LightLoop loop = settings::LightLoop::kLists;
};

constexpr Way kWays[] = {
    {"deferred, raster", Renderer::kClusteredDeferred, LightingStage::kAuto, GeometryPath::kRaster},
    {"deferred, visibility", Renderer::kClusteredDeferred, LightingStage::kAuto,
     GeometryPath::kVisibility},
    {"deferred, compute raster", Renderer::kClusteredDeferred, LightingStage::kAuto,
     GeometryPath::kComputeRaster},
    {"deferred, compute raster, not culled", Renderer::kClusteredDeferred, LightingStage::kAuto,
     GeometryPath::kComputeRaster, false},
    {"deferred, compute raster, all lights", Renderer::kClusteredDeferred, LightingStage::kAuto,
     GeometryPath::kComputeRaster, true, settings::LightLoop::kAllLights},
    {"forward_plus, fragment", Renderer::kForwardPlus, LightingStage::kFragment,
     GeometryPath::kAuto},
    {"forward_plus, compute", Renderer::kForwardPlus, LightingStage::kCompute, GeometryPath::kAuto},
    {"naive, compute", Renderer::kNaive, LightingStage::kCompute, GeometryPath::kAuto},
};

struct Picture {
    std::vector<float> rgb;
    std::vector<int> rgba8;
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

Picture drawTimed(render::ViewRenderer& view, render::FrameInputs inputs, const char* name) {
    std::map<std::string, std::vector<double>> passes;
    std::vector<std::string> order;
    std::vector<double> gpu;
    std::vector<double> host;
    for (uint32_t i = 0; i < kWarmup + kFrames; ++i) {
        view.submit(inputs).value();
        const auto frame = std::move(view.collect()).value();
        if (i < kWarmup) {
            continue;
        }
        gpu.push_back(frame.stats.gpu_us.value_or(NAN));
        host.push_back(frame.stats.host_us);
        for (const auto& pass : frame.stats.passes) {
            if (passes[pass.name].empty()) {
                order.push_back(pass.name);
            }
            passes[pass.name].push_back(pass.gpu_us.value_or(NAN));
        }
    }
    std::printf("%-34s gpu %8.1f us, host %7.1f us:", name, median(gpu), median(host));
    for (const auto& pass : order) {
        std::printf(" %s %.1f", pass.c_str(), median(passes[pass]));
    }
    std::printf("\n");
    inputs.outputs = {Output::kRadiance};
    view.submit(inputs).value();
    const auto frame = std::move(view.collect()).value();
    const auto& pixels = frame.pixels.view();
    Picture picture{radianceOf(pixels).rgb, {}};
    for (size_t i = 0; i < pixels.stride_bytes * pixels.height_px; ++i) {
        picture.rgba8.own().push_back(std::to_integer<int>(pixels.data[i]));
    }
    return picture;
}

void compare(const Picture& a, const Picture& b, const char* what) {
    double worst = 0;
    double squares = 0;
    size_t bits = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        const double d = std::abs(static_cast<double>(a.rgb[i]) - static_cast<double>(b.rgb[i]));
        worst = std::max(worst, d);
        squares += d * d;
        bits += std::memcmp(&a.rgb[i], &b.rgb[i], sizeof(float)) != 0 ? 1U : 0U;
    }
    size_t above[2] = {0, 0};
    for (size_t i = 0; i < a.rgba8.size(); i += 4) {
        int step = 0;
        for (size_t c = 0; c < 3; ++c) {
            step = std::max(step, std::abs(a.rgba8[i + c] - b.rgba8[i + c]));
        }
        above[0] += step > 1 ? 1U : 0U;
        above[1] += step > 8 ? 1U : 0U;
    }
    const auto pixels = static_cast<double>(a.rgba8.size()) / 4;
    std::printf("  %-40s %s; max %.3g, rmse %.3g; >1/255 %.4f %%, >8/255 %.4f %% of pixels\n", what,
                bits == 0 ? "equal bits" : "differ", worst,
                std::sqrt(squares / static_cast<double>(a.rgb.size())),
                100 * static_cast<double>(above[0]) / pixels,
                100 * static_cast<double>(above[1]) / pixels);
}

Visibility visibilityOf(render::ViewRenderer& view,
                        const scene::Scene& scene,
                        render::FrameInputs inputs,
                        GeometryPath path) {
    inputs.settings.renderer = Renderer::kClusteredDeferred;
    inputs.settings.lighting = LightingStage::kAuto;
    inputs.geometry = path;
    view.submit(inputs).value();
    (void)view.collect().value();
    return std::move(view.readVisibility(scene)).value();
}

// The rasteriser's ids and depths against those rastered in compute.
void compareIds(render::ViewRenderer& view,
                const scene::Scene& scene,
                const render::FrameInputs& inputs) {
    const auto a = visibilityOf(view, scene, inputs, GeometryPath::kVisibility);
    const auto b = visibilityOf(view, scene, inputs, GeometryPath::kComputeRaster);
    size_t apart = 0;
    size_t empty = 0;
    std::vector<double> ulps;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        if (a.pixels[i] != b.pixels[i]) {
            ++apart;
            empty += (a.depths[i] > 0) != (b.depths[i] > 0) ? 1U : 0U;
        } else if (a.depths[i] > 0) {
            ulps.push_back(std::abs(static_cast<double>(std::bit_cast<int32_t>(a.depths[i])) -
                                    static_cast<double>(std::bit_cast<int32_t>(b.depths[i]))));
        }
    }
    std::sort(ulps.begin(), ulps.end());
    const auto at = [&](double share) {
        return ulps.empty()
                   ? 0
                   : ulps[static_cast<size_t>(share * static_cast<double>(ulps.size() - 1))];
    };
    std::printf("  ids: %zu of %zu pixels show another triangle (%zu are empty in one); depths of "
                "the others apart by %.0f (median), %.0f (p99), %.0f ulps (most)\n",
                apart, a.pixels.size(), empty, at(0.5), at(0.99), at(1));
}

void run(const scene::Scene& scene, const settings::Camera& camera, uint32_t lights) {
    gpu::Device device({});
    render::Renderer renderer(device, scene);
    render::ViewRenderer view(renderer);
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {1920, 1080};
    inputs.settings.lights.count = lights;
    inputs.time_s = 1;
    if (scene.name != "hall" && scene.name.find("ponza") != std::string::npos) {
        inputs.settings.lights.box = BoundsD3{{-10, 0, -5}, {10, 8, 5}};
    }
    std::printf("%s, %u lights, 1920x1080\n", scene.name.c_str(), lights);
    std::vector<Picture> pictures;
    for (const auto& way : kWays) {
        inputs.settings.renderer = way.renderer;
        inputs.settings.lighting = way.lighting;
        inputs.settings.light_loop = way.loop;
        inputs.geometry = way.geometry;
        inputs.cull_meshlets = way.cull;
        pictures.push_back(drawTimed(view, inputs, way.name));
    }
    compare(pictures[0], pictures[1], "deferred: raster, visibility");
    compare(pictures[1], pictures[2], "visibility: rasteriser, compute raster");
    compare(pictures[2], pictures[3], "compute raster: culled, not culled");
    compare(pictures[2], pictures[4], "compute raster: lists, all lights");
    compare(pictures[5], pictures[6], "forward_plus: fragment, compute");
    compare(pictures[6], pictures[7], "compute: forward_plus, naive");
    compareIds(view, scene, inputs);
}

} // namespace

int main(int argc, char** argv) try {
    const uint32_t lights = argc > 2 ? static_cast<uint32_t>(std::atoi(argv[2])) : 1000;
    if (argc > 1 && std::string(argv[1]) != "hall") {
        auto scene = std::move(gltf::load(argv[1])).value();
        scene.name = "Sponza";
        run(scene, settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0}), lights);
    } else {
        const auto scene = builtin_scene::makeHall();
        run(scene, scene.cameras.front().camera, lights);
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
