// Prices G-buffer layouts and times the geometry pass.
//   gbuffer_layouts SCENE.gltf|builtin error|time [cpu|gpu] [frames]
// error: radiance of each layout against the default and against forward shading (1,000 lights,
// 640x360). time: each layout's passes and the process's CPU time a frame (0 lights, 1280x720).
#include "builtin_scene/hall.h"
#include "gltf/gltf_loader.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/view/renderer.h"
#include "settings/camera.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <sys/resource.h>
#include <vector>

namespace {

using namespace froxel;

double processMs() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto ms = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_usec) * 1e-3;
    };
    return ms(usage.ru_utime) + ms(usage.ru_stime);
}

render::FrameInputs standardView(const scene::Scene& scene, bool builtin) {
    render::FrameInputs inputs;
    auto& s = inputs.settings;
    if (builtin) {
        s.camera = scene.cameras.front().camera;
    } else {
        s.camera = settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0});
        s.camera.yfov_rad = 0.785398163397448;
        s.lights.box = BoundsD3{{-10, 0, -5}, {10, 8, 5}};
    }
    return inputs;
}

std::string nameOf(const settings::GbufferLayout& layout) {
    return std::string(settings::kNormalEncodingNames[static_cast<size_t>(layout.normal)]) + "+" +
           std::string(settings::kPositionSourceNames[static_cast<size_t>(layout.position)]);
}

// Every normal encoding with the hardware's depth, every position source with the default normal.
std::vector<settings::GbufferLayout> layouts() {
    std::vector<settings::GbufferLayout> all;
    for (size_t n = 0; n < settings::kNormalEncodingNames.size(); ++n) {
        all.push_back({static_cast<settings::NormalEncoding>(n), settings::PositionSource::kDepth});
    }
    for (size_t p = 1; p < settings::kPositionSourceNames.size(); ++p) {
        all.push_back({settings::NormalEncoding::kOct16, static_cast<settings::PositionSource>(p)});
    }
    // What the seeds store.
    all.push_back({settings::NormalEncoding::kXyz16, settings::PositionSource::kFp16});
    return all;
}

render::RenderedFrame drawOne(render::ViewRenderer& view, const render::FrameInputs& inputs) {
    view.submit(inputs).value();
    return std::move(view.collect()).value();
}

struct Picture {
    std::vector<float> radiance;
    std::vector<int> rgba8;
};

Picture drawPicture(render::ViewRenderer& view, render::FrameInputs inputs) {
    inputs.outputs = {Output::kRadiance};
    const auto frame = drawOne(view, inputs);
    const auto& pixels = frame.pixels.view();
    Picture picture{radianceOf(pixels).rgb, {}};
    for (size_t i = 0; i < pixels.stride_bytes * pixels.height_px; ++i) {
        picture.rgba8.own().push_back(std::to_integer<int>(pixels.data[i]));
    }
    return picture;
}

// Differences of linear radiance, and of what is seen.
void printError(const Picture& reference, const Picture& other) {
    std::vector<double> differences;
    double squares = 0;
    double relative = 0;
    for (size_t i = 0; i < reference.radiance.size(); ++i) {
        const double a = other.radiance[i];
        const double b = reference.radiance[i];
        const double d = std::abs(a - b);
        differences.push_back(d);
        squares += d * d;
        relative += d * d / (b * b + 1e-2);
    }
    size_t above = 0;
    for (size_t i = 0; i < reference.rgba8.size(); ++i) {
        above += std::abs(reference.rgba8[i] - other.rgba8[i]) > 1 ? 1U : 0U;
    }
    const auto count = static_cast<double>(differences.size());
    std::sort(differences.begin(), differences.end());
    std::printf(" %10.3g %10.3g %10.3g %10.3g %8.3f %%", differences.back(),
                differences[differences.size() * 999 / 1000], std::sqrt(squares / count),
                std::sqrt(relative / count), 100 * static_cast<double>(above) / count);
}

void priceErrors(render::Renderer& renderer, render::FrameInputs inputs) {
    render::ViewRenderer view(renderer);
    inputs.settings.size = {640, 360};
    inputs.settings.lights.count = 1000;
    inputs.time_s = 5;
    const Picture deferred = drawPicture(view, inputs);
    inputs.settings.renderer = settings::Renderer::kForwardPlus;
    const Picture forward = drawPicture(view, inputs);
    inputs.settings.renderer = settings::Renderer::kClusteredDeferred;
    std::printf("%-22s %5s | against the default: max, p99.9, RMSE, relative RMSE, over 1/255 | "
                "the same against forward\n",
                "layout", "bytes");
    for (const auto& layout : layouts()) {
        inputs.settings.gbuffer = layout;
        const Picture picture = drawPicture(view, inputs);
        std::printf("%-22s %5u |", nameOf(layout).c_str(),
                    render::gbufferBytesPerPixel(layout, false, false));
        printError(deferred, picture);
        std::printf(" |");
        printError(forward, picture);
        std::printf("\n");
        std::fflush(stdout);
    }
}

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

void timeFrames(render::Renderer& renderer,
                const render::FrameInputs& inputs,
                const std::string& name,
                int frames) {
    render::ViewRenderer view(renderer);
    std::map<std::string, std::vector<double>> passes;
    std::vector<double> cpu;
    drawOne(view, inputs);
    for (int i = 0; i < frames; ++i) {
        const double before = processMs();
        const auto frame = drawOne(view, inputs);
        cpu.push_back(processMs() - before);
        for (const auto& pass : frame.stats.passes) {
            if (pass.gpu_us) {
                passes[pass.name].push_back(*pass.gpu_us / 1000);
            }
        }
    }
    std::printf("%-34s CPU %7.1f ms, least %7.1f;", name.c_str(), median(cpu),
                *std::min_element(cpu.begin(), cpu.end()));
    for (auto& [pass, times] : passes) {
        std::printf(" %s %.2f", pass.c_str(), median(times));
    }
    std::printf("\n");
    std::fflush(stdout);
}

void timeAll(render::Renderer& renderer, render::FrameInputs inputs, int frames) {
    inputs.settings.size = {1280, 720};
    inputs.settings.lights.count = 0;
    for (const auto shading : {settings::ShadingModel::kPbr, settings::ShadingModel::kLambert}) {
        inputs.settings.shading = shading;
        timeFrames(renderer, inputs,
                   std::string(settings::kShadingModelNames[static_cast<size_t>(shading)]), frames);
    }
    inputs.settings.shading = settings::ShadingModel::kPbr;
    inputs.settings.renderer = settings::Renderer::kForwardPlus; // its prepass is the raster floor
    timeFrames(renderer, inputs, "forward_plus", frames);
    inputs.settings.renderer = settings::Renderer::kClusteredDeferred;
    for (const auto& layout : layouts()) {
        inputs.settings.gbuffer = layout;
        timeFrames(renderer, inputs, nameOf(layout), frames);
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::string path = argc > 1 ? argv[1] : "builtin";
    const std::string mode = argc > 2 ? argv[2] : "error";
    const bool gpu = argc > 3 && std::string(argv[3]) == "gpu";
    const int frames = argc > 4 ? std::max(1, std::atoi(argv[4])) : 12;
    const bool builtin = path == "builtin";
    const scene::Scene scene = builtin ? builtin_scene::makeHall() : gltf::load(path).value();
    gpu::DeviceOptions options;
    options.choice = gpu ? gpu::DeviceChoice::kGpu : gpu::DeviceChoice::kCpu;
    gpu::Device device(options);
    render::Renderer renderer(device, scene);
    const auto inputs = standardView(scene, builtin);
    if (mode == "time") {
        timeAll(renderer, inputs, frames);
    } else {
        priceErrors(renderer, inputs);
    }
    return 0;
}
