// What occlusion culling could save at most: a view's frames without lights, drawn in turns from
// the whole scene, from the triangles alone that the picture shows, from the meshlets that have
// such a triangle, and from these again behind a depth prepass of their own: what culling in two
// passes comes to if the last frame showed the same and the tests cost nothing. occlusion_bound
// [SCENE.gltf|hall]; on a GPU where there is one.
#include "builtin_scene/hall.h"
#include "gltf/gltf_loader.h"
#include "render/scene/geometry_pack.h"
#include "render/view/renderer.h"
#include "render/view/visibility_readback.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
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

using render::Corners;

Corners cornersAt(const std::vector<uint32_t>& indices, size_t first) {
    return render::fromLowest({indices[first], indices[first + 1], indices[first + 2]});
}

// The indices of those meshlets of a primitive that have a triangle of `visible`.
std::vector<uint32_t> visibleMeshlets(const render::PackedGeometry& packed,
                                      const render::PackedPrimitive& primitive,
                                      const std::set<Corners>& visible) {
    std::vector<uint32_t> kept;
    for (uint32_t m = 0; m < primitive.meshlet_count; ++m) {
        const auto& meshlet = packed.triangles.meshlets[primitive.first_meshlet + m];
        bool shows = false;
        for (uint32_t i = 0; i < meshlet.index_count && !shows; i += 3) {
            shows = visible.contains(cornersAt(packed.triangles.indices, meshlet.first_index + i));
        }
        if (shows) {
            const auto first = packed.triangles.indices.begin() + meshlet.first_index;
            kept.insert(kept.end(), first, first + meshlet.index_count);
        }
    }
    return kept;
}

// Every instance gets a mesh of its own with what is visible of it: its triangles, or with `packed`
// the meshlets that they are in.
scene::Scene onlyVisible(const scene::Scene& whole,
                         const std::set<Triangle>& visible,
                         const render::PackedGeometry* packed) {
    scene::Scene scene = whole;
    scene.meshes.clear();
    for (uint32_t i = 0; i < whole.instances.size(); ++i) {
        const uint32_t whole_mesh = whole.instances[i].mesh;
        scene::Mesh mesh = whole.meshes[whole_mesh];
        for (uint32_t p = 0; p < mesh.primitives.size(); ++p) {
            auto& indices = mesh.primitives[p].indices;
            const auto all = std::exchange(indices, {});
            std::set<Corners> corners;
            for (auto at = visible.lower_bound({i, p, 0});
                 at != visible.end() && std::get<0>(*at) == i && std::get<1>(*at) == p; ++at) {
                const auto first = all.begin() + 3 * std::get<2>(*at);
                indices.insert(indices.end(), first, first + 3);
                corners.insert(cornersAt(all, 3 * size_t{std::get<2>(*at)}));
            }
            if (packed != nullptr) {
                indices = visibleMeshlets(*packed, packed->meshes[whole_mesh][p], corners);
            }
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
        if (pass.gpu_us) {
            timed->passes_us[pass.name].push_back(*pass.gpu_us);
        }
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

void run(const scene::Scene& scene, const settings::Camera& camera) {
    gpu::Device device({});
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {1280, 720};
    inputs.settings.lights.count = 0;
    inputs.settings.lights.scene_lights = false;
    render::Renderer renderer(device, scene);
    const auto seen = render::readVisibility(renderer, scene, inputs).value();
    const auto triangles = visibleTriangles(seen);
    const auto packed = render::packGeometry(scene);
    render::Renderer of_triangles(device, onlyVisible(scene, triangles, nullptr));
    render::Renderer of_meshlets(device, onlyVisible(scene, triangles, &packed));
    struct Variant {
        const char* name;
        render::ViewRenderer view;
        bool prepass;
        Timed timed{};
    };
    std::array variants = {
        Variant{"  whole scene", render::ViewRenderer(renderer), false},
        Variant{"  visible triangles", render::ViewRenderer(of_triangles), false},
        Variant{"  visible meshlets", render::ViewRenderer(of_meshlets), false},
        Variant{"  the same behind a depth prepass", render::ViewRenderer(of_meshlets), true}};
    for (int i = -3; i < kFrames; ++i) {
        for (auto& variant : variants) {
            inputs.depth_prepass = variant.prepass;
            draw(variant.view, inputs, i < 0 ? nullptr : &variant.timed);
        }
    }
    std::printf("%s, 1280x720, %zu triangles visible\n", scene.name.c_str(), triangles.size());
    for (const auto& variant : variants) {
        print(variant.name, variant.timed);
    }
}

} // namespace

int main(int argc, char** argv) try {
    const std::string path = argc > 1 ? argv[1] : "hall";
    if (path == "hall") {
        const auto scene = builtin_scene::makeHall();
        run(scene, scene.cameras.front().camera);
    } else {
        const auto scene = gltf::load(path).value();
        run(scene, settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0}));
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "occlusion_bound: %s\n", error.what());
    return 1;
}
