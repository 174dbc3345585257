// What occlusion culling could save at most: a view's frames without lights, drawn from the whole
// scene and from the triangles alone that the picture shows, in turns.
// occlusion_bound [SCENE.gltf|hall]; on a GPU where there is one.
#include "gltf/gltf_loader.h"
#include "hall/hall.h"
#include "render/renderer.h"
#include "render/visibility_readback.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace {

using namespace froxel;

constexpr int kFrames = 30;

using Triangle = std::tuple<uint32_t, uint32_t, uint32_t>; // instance, primitive, triangle

std::set<Triangle> visibleTriangles(const Visibility& visibility) {
    std::set<Triangle> found;
    for (const auto& pixel : visibility.pixels) {
        if (pixel.instance != VisibleTriangle::kNothing) {
            found.emplace(pixel.instance, pixel.primitive, pixel.triangle);
        }
    }
    return found;
}

// Every instance gets a mesh of its own with what is visible of it.
scene::Scene onlyVisible(const scene::Scene& whole, const std::set<Triangle>& visible) {
    scene::Scene scene = whole;
    scene.meshes.clear();
    for (uint32_t i = 0; i < whole.instances.size(); ++i) {
        scene::Mesh mesh = whole.meshes[whole.instances[i].mesh];
        for (auto& primitive : mesh.primitives) {
            primitive.indices.clear();
        }
        for (auto at = visible.lower_bound({i, 0, 0}); at != visible.end() && std::get<0>(*at) == i;
             ++at) {
            const auto [instance, primitive, triangle] = *at;
            const auto& from = whole.meshes[whole.instances[i].mesh].primitives[primitive].indices;
            auto& to = mesh.primitives[primitive].indices;
            to.insert(to.end(), from.begin() + 3 * triangle, from.begin() + 3 * triangle + 3);
        }
        std::erase_if(mesh.primitives, [](const auto& p) { return p.indices.empty(); });
        scene.instances[i].mesh = static_cast<uint32_t>(scene.meshes.size());
        scene.meshes.push_back(std::move(mesh));
    }
    std::erase_if(scene.instances,
                  [&](const auto& i) { return scene.meshes[i.mesh].primitives.empty(); });
    return scene;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Timed {
    std::map<std::string, std::vector<double>> passes_us;
    std::vector<double> cpu_us; // of all threads of the process
    uint32_t triangle_count = 0;
};

void draw(render::ViewRenderer& view, const render::FrameInputs& inputs, Timed* timed) {
    const std::clock_t start = std::clock();
    view.submit(inputs).value();
    const auto frame = view.collect();
    if (timed == nullptr) {
        return;
    }
    timed->cpu_us.push_back(1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    timed->triangle_count = frame->stats.triangle_count;
    for (const auto& pass : frame->stats.passes) {
        timed->passes_us[pass.name].push_back(pass.gpu_us);
    }
}

void print(const char* name, const Timed& timed) {
    std::printf("%s: %u triangles, CPU time %.0f us, passes", name, timed.triangle_count,
                median(timed.cpu_us));
    for (const auto& [pass, times] : timed.passes_us) {
        std::printf(" %s %.0f", pass.c_str(), median(times));
    }
    std::printf("\n");
}

void run(const scene::Scene& scene, const view::Camera& camera) {
    gpu::Device device({});
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {1280, 720};
    inputs.settings.lights.count = 0;
    inputs.settings.lights.scene_lights = false;
    render::Renderer renderer(device, scene);
    const auto seen = render::readVisibility(renderer, scene, inputs).value();
    const auto triangles = visibleTriangles(seen);
    const auto reduced_scene = onlyVisible(scene, triangles);
    render::Renderer reduced_renderer(device, reduced_scene);
    render::ViewRenderer whole_view(renderer);
    render::ViewRenderer reduced_view(reduced_renderer);
    Timed whole;
    Timed reduced;
    for (int i = -3; i < kFrames; ++i) {
        draw(whole_view, inputs, i < 0 ? nullptr : &whole);
        draw(reduced_view, inputs, i < 0 ? nullptr : &reduced);
    }
    std::printf("%s, 1280x720, %zu triangles visible\n", scene.name.c_str(), triangles.size());
    print("  whole scene", whole);
    print("  visible triangles alone", reduced);
}

} // namespace

int main(int argc, char** argv) try {
    const std::string path = argc > 1 ? argv[1] : "hall";
    if (path == "hall") {
        const auto scene = hall::makeHall();
        run(scene, scene.cameras.front().camera);
    } else {
        const auto scene = gltf::load(path).value();
        run(scene, view::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0}));
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "occlusion_bound: %s\n", error.what());
    return 1;
}
