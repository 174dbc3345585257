// Which pixels a triangle rastered in compute covers: against integer arithmetic on the host, where
// each pixel must belong to exactly one triangle of a mesh without gaps.
#include "render/frame/frame_uniforms.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"

#include <array>
#include <cmath>
#include <random>

namespace froxel::test {

namespace {

using render::GeometryPath;

class ComputeRasterCover : public GpuTest {};

// Distance of the meshes: a power of two, so that dividing by it does not round.
constexpr float kDistance = 4;

struct MeshShape {
    uint32_t cells;  // a side
    float half_size; // of the whole, m
    float jitter;    // of the vertices inside, cells
    float lean;      // of the plane: change of distance over its half size, m
};

// A grid in front of the eye, its inner vertices moved about in its plane.
scene::Scene meshScene(const MeshShape& shape, uint32_t seed, bool mirrored, bool both_sides) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> shift(-shape.jitter, shape.jitter);
    scene::Primitive p;
    const uint32_t row = shape.cells + 1;
    const float cell = 2 * shape.half_size / static_cast<float>(shape.cells);
    for (uint32_t y = 0; y < row; ++y) {
        for (uint32_t x = 0; x < row; ++x) {
            const bool inner = x > 0 && y > 0 && x < shape.cells && y < shape.cells;
            const glm::vec2 at(static_cast<float>(x) + (inner ? shift(random) : 0.0F),
                               static_cast<float>(y) + (inner ? shift(random) : 0.0F));
            const glm::vec2 xy = at * cell - shape.half_size;
            p.positions.emplace_back(mirrored ? -xy.x : xy.x, xy.y,
                                     -kDistance + xy.x / shape.half_size * shape.lean);
            p.normals.emplace_back(0, 0, 1);
            p.bounds.add(p.positions.back());
        }
    }
    for (uint32_t y = 0; y < shape.cells; ++y) {
        for (uint32_t x = 0; x < shape.cells; ++x) {
            const uint32_t a = y * row + x;
            if (random() % 2 == 0) {
                p.indices.insert(p.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
            } else {
                p.indices.insert(p.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
            }
        }
    }
    if (mirrored) { // the instance mirrors positions back; a file's winding is the mesh's own
        for (size_t i = 0; i < p.indices.size(); i += 3) {
            std::swap(p.indices[i], p.indices[i + 1]);
        }
    }
    scene::Scene scene;
    scene.name = "mesh";
    scene::Material material;
    material.double_sided = both_sides;
    scene.materials = {material};
    scene.meshes = {{"mesh", {p}}};
    scene::Instance instance{.mesh = 0, .world_from_object = glm::dmat4(1), .name = {}};
    instance.world_from_object[0][0] = mirrored ? -1 : 1;
    scene.instances.push_back(instance);
    scene.bounds_world.add(glm::dvec3(-shape.half_size, -shape.half_size, -2 * kDistance));
    scene.bounds_world.add(glm::dvec3(shape.half_size, shape.half_size, 0));
    return scene;
}

render::FrameInputs inputsFor(settings::Size size) {
    render::FrameInputs inputs;
    inputs.settings.camera = settings::lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
    inputs.settings.size = size;
    inputs.settings.lights.count = 0;
    inputs.geometry = GeometryPath::kComputeRaster;
    return inputs;
}

Visibility look(gpu::Device& device, const scene::Scene& scene, const render::FrameInputs& inputs) {
    render::Renderer renderer(device, scene);
    render::ViewRenderer view(renderer);
    (void)draw(view, inputs);
    auto visibility = view.readVisibility(scene);
    EXPECT_TRUE(visibility);
    return visibility ? *visibility : Visibility{};
}

using Point = glm::i64vec2;

// In 1/256 of a pixel; the shader's own steps, none of which another order could round otherwise.
Point snapped(const glm::vec3& position, const io::Frame& frame) {
    const glm::vec2 ndc = glm::vec2(position) * frame.camera.clip_scale / -position.z;
    const glm::vec2 size(frame.camera.width_px, frame.camera.height_px);
    const glm::vec2 at = glm::floor(ndc * (0.5F * size * 256.0F) + 0.5F);
    return Point(at) + Point(frame.camera.width_px, frame.camera.height_px) * int64_t{128};
}

bool covers(std::array<Point, 3> t, Point center) {
    const auto cross = [](Point a, Point b) { return a.x * b.y - a.y * b.x; };
    if (cross(t[1] - t[0], t[2] - t[0]) < 0) {
        std::swap(t[1], t[2]);
    }
    for (size_t i = 0; i < 3; ++i) {
        const Point edge = t[(i + 1) % 3] - t[i];
        const int64_t side = cross(edge, center - t[i]);
        const bool left = edge.y < 0;
        const bool top = edge.y == 0 && edge.x > 0;
        if (side < 0 || (side == 0 && !left && !top)) {
            return false;
        }
    }
    return cross(t[1] - t[0], t[2] - t[0]) != 0;
}

// For each pixel the triangles that cover it.
std::vector<std::vector<uint32_t>> coverOnHost(const scene::Scene& scene, const io::Frame& frame) {
    const auto& p = scene.meshes[0].primitives[0];
    std::vector<std::vector<uint32_t>> cover(size_t{frame.camera.width_px} *
                                             frame.camera.height_px);
    const auto sign = static_cast<float>(scene.instances[0].world_from_object[0][0]);
    for (uint32_t i = 0; 3 * size_t{i} < p.indices.size(); ++i) {
        std::array<Point, 3> t;
        for (size_t k = 0; k < 3; ++k) {
            auto position = p.positions[p.indices[3 * size_t{i} + k]];
            position.x *= sign;
            t[k] = snapped(position, frame);
        }
        const auto low = glm::min(t[0], glm::min(t[1], t[2])) / int64_t{256};
        const auto high = glm::max(t[0], glm::max(t[1], t[2])) / int64_t{256};
        for (int64_t y = std::max<int64_t>(low.y, 0); y <= high.y && y < frame.camera.height_px;
             ++y) {
            for (int64_t x = std::max<int64_t>(low.x, 0); x <= high.x && x < frame.camera.width_px;
                 ++x) {
                if (covers(t, Point(x * 256 + 128, y * 256 + 128))) {
                    cover[static_cast<size_t>(y) * frame.camera.width_px + static_cast<size_t>(x)]
                        .push_back(i);
                }
            }
        }
    }
    return cover;
}

void expectEachPixelOnce(gpu::Device& device,
                         const MeshShape& shape,
                         bool mirrored,
                         settings::Size size = {333, 201}) {
    for (uint32_t seed = 1; seed <= 3; ++seed) {
        const auto scene = meshScene(shape, seed, mirrored, false);
        const auto inputs = inputsFor(size);
        const auto frame = render::makeFrameUniforms(
            inputs.settings, render::makeProjection(inputs.settings.camera, size, 100), nullptr, 0,
            0);
        const auto cover = coverOnHost(scene, frame);
        const auto seen = look(device, scene, inputs);
        ASSERT_EQ(seen.pixels.size(), cover.size());
        size_t wrong = 0;
        size_t not_one = 0;
        for (size_t i = 0; i < cover.size(); ++i) {
            not_one += cover[i].size() != 1 ? 1U : 0U;
            wrong += cover[i].size() != 1 || seen.pixels[i].triangle != cover[i][0] ||
                             seen.pixels[i].instance != 0
                         ? 1U
                         : 0U;
        }
        EXPECT_EQ(not_one, 0U) << "the mesh itself";
        EXPECT_EQ(wrong, 0U) << "of " << cover.size() << ", seed " << seed;
    }
}

} // namespace

TEST_F(ComputeRasterCover, TrianglesOfAPixel_EachPixel_IsOneTriangles) {
    expectEachPixelOnce(device(), {.cells = 300, .half_size = 4, .jitter = 0.2F, .lean = 0}, false);
}

TEST_F(ComputeRasterCover, SmallTriangles_EachPixel_IsOneTriangles) {
    expectEachPixelOnce(device(), {.cells = 40, .half_size = 4, .jitter = 0.2F, .lean = 0}, false);
}

TEST_F(ComputeRasterCover, LargeTriangles_EachPixel_IsOneTriangles) {
    expectEachPixelOnce(device(), {.cells = 4, .half_size = 6, .jitter = 0.2F, .lean = 0}, false);
}

TEST_F(ComputeRasterCover, TrianglesFarBeyondTheScreen_EachPixel_IsOneTriangles) {
    expectEachPixelOnce(device(), {.cells = 2, .half_size = 90, .jitter = 0.2F, .lean = 0}, false);
}

TEST_F(ComputeRasterCover, RegularGrid_CentresOnEdges_EachPixelIsOneTriangles) {
    // Half a pixel a cell and more: many pixels' centres lie on edges and corners.
    expectEachPixelOnce(device(), {.cells = 128, .half_size = 4, .jitter = 0, .lean = 0}, false,
                        {128, 64});
}

TEST_F(ComputeRasterCover, Mirrored_EachPixel_IsOneTriangles) {
    expectEachPixelOnce(device(), {.cells = 40, .half_size = 4, .jitter = 0.2F, .lean = 0}, true);
}

TEST_F(ComputeRasterCover, BackFaces_AreSeenWhereBothSidesAre) {
    const MeshShape shape{.cells = 12, .half_size = 4, .jitter = 0.2F, .lean = 0};
    for (const bool mirrored : {false, true}) {
        for (const bool both_sides : {false, true}) {
            auto scene = meshScene(shape, 7, mirrored, both_sides);
            auto& indices = scene.meshes[0].primitives[0].indices;
            for (size_t i = 0; i < indices.size(); i += 3) {
                std::swap(indices[i], indices[i + 1]);
            }
            const auto seen = look(device(), scene, inputsFor({64, 40}));
            for (const float depth : seen.depths) {
                ASSERT_EQ(depth > 0, both_sides);
            }
        }
    }
}

// A plane from 10 m before to 2 m behind the eye, whose depth is known at every pixel: no worse
// than the rasteriser's.
TEST_F(ComputeRasterCover, LeaningPlaneThroughTheNearPlane_Depths_AreThePlanes) {
    constexpr settings::Size kSize{160, 90};
    const auto worstOf = [&](const scene::Scene& scene, GeometryPath path) {
        auto inputs = inputsFor(kSize);
        inputs.geometry = path;
        const auto seen = look(device(), scene, inputs);
        const auto frame = render::makeFrameUniforms(
            inputs.settings, render::makeProjection(inputs.settings.camera, kSize, 100), nullptr, 0,
            0);
        double worst = 0;
        for (uint32_t y = 0; y < kSize.height_px; ++y) {
            for (uint32_t x = 0; x < kSize.width_px; ++x) {
                // z = -4 - x * 6 / 40 on the ray (r, s, -1) * distance
                const double r = (x + 0.5) * static_cast<double>(frame.camera.ray_scale.x) +
                                 static_cast<double>(frame.camera.ray_offset.x);
                const double expected = (1 - r * 6 / 40) / 4 * inputs.settings.camera.near_m;
                const double depth =
                    static_cast<double>(seen.depths[size_t{y} * kSize.width_px + x]);
                worst = std::max(worst, std::abs(depth / expected - 1));
            }
        }
        return worst;
    };
    for (const uint32_t cells : {1U, 7U, 64U}) {
        const auto scene = meshScene({.cells = cells, .half_size = 40, .jitter = 0.2F, .lean = -6},
                                     3, false, true);
        const double compute = worstOf(scene, GeometryPath::kComputeRaster);
        const double raster = worstOf(scene, GeometryPath::kVisibility);
        std::printf("%u cells a side: depth off by %.3g at most, the rasteriser's by %.3g\n", cells,
                    compute, raster);
        EXPECT_LT(compute, 1e-5) << cells;
        EXPECT_LT(compute, 2 * raster + 1e-6) << cells;
    }
}

} // namespace froxel::test
