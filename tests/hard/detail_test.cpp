// Coarser levels of meshes: none at no error, as near as the error says, no crack, no jump.
#include "support/ball.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace froxel::test {

namespace {

using render::GeometryPath;
using settings::Renderer;

class HardDetail : public SharedGpuTest {
  protected:
    static std::vector<GeometryPath> paths() {
        std::vector<GeometryPath> all = {GeometryPath::kRaster, GeometryPath::kVisibility};
        if (device().traits().int64_atomics) {
            all.push_back(GeometryPath::kComputeRaster);
        }
        return all;
    }
};

constexpr settings::Size kSize{96, 72};
const render::SceneOptions kLevels{.detail_levels = true};

scene::Material ink() {
    scene::Material material = chalk();
    material.base_color = {0, 0, 0, 1};
    material.unlit = true;
    return material;
}

scene::Primitive bumpyBall(uint32_t rings) {
    Ball ball = makeBall(rings, [](const glm::vec3& way) {
        return 1 + 0.06F * std::sin(9 * way.x) * std::sin(8 * way.y + 1) * std::sin(7 * way.z);
    });
    scene::Primitive primitive;
    for (const glm::vec3& p : ball.positions) {
        primitive.normals.push_back(glm::normalize(p));
        primitive.bounds.add(p);
    }
    primitive.positions = std::move(ball.positions);
    primitive.indices = std::move(ball.indices);
    return primitive;
}

// Where the ball may be: plainly, stretched and mirrored, and flat.
std::vector<glm::dmat4> ballPlaces() {
    glm::dmat4 stretched(1);
    stretched[0] = {-0.4, 0.2, 0, 0};
    stretched[1] = {0, 1.5, 0.3, 0};
    stretched[3] = {2.6, 0, -1, 1};
    glm::dmat4 flat(1);
    flat[1] = {0, 0, 0, 0};
    flat[3] = {0, -1.4, 0, 1};
    return {glm::dmat4(1), stretched, flat};
}

scene::Scene balls(const scene::Material& material, const std::vector<glm::dmat4>& at) {
    SceneMaker maker(material);
    maker.add(bumpyBall(72), at.front());
    for (size_t i = 1; i < at.size(); ++i) {
        scene::Instance instance;
        instance.world_from_object = at[i];
        maker.scene.instances.push_back(instance);
    }
    maker.scene.bounds_world.add({-4, -2, -3});
    maker.scene.bounds_world.add({4, 2, 2});
    maker.point({0, 3, 2}, 8, 20);
    return std::move(maker.scene);
}

render::FrameInputs seenFrom(const glm::dvec3& eye, float error_px = 0) {
    render::FrameInputs inputs;
    inputs.settings.size = kSize;
    inputs.settings.camera = settings::lookAt(eye, {0.8, 0, -0.4}, {0, 1, 0});
    inputs.settings.lights.count = 20;
    inputs.settings.background.color = {1, 1, 1};
    inputs.settings.geometry_error_px = error_px;
    return inputs;
}

bool isDark(const Picture& picture, uint32_t x, uint32_t y) {
    return std::to_integer<uint32_t>(picture.rgba8[(size_t{y} * picture.width_px + x) * 4]) < 128;
}

// Pixels that differ though all within `reach` of them are alike in `exact`: holes inside a
// surface, surfaces where there is none.
uint32_t strayPixels(const Picture& exact, const Picture& coarse, int reach) {
    const auto width = static_cast<int>(exact.width_px);
    const auto height = static_cast<int>(exact.height_px);
    uint32_t count = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto dark = [](const Picture& of, int at_x, int at_y) {
                return isDark(of, static_cast<uint32_t>(at_x), static_cast<uint32_t>(at_y));
            };
            bool alike = dark(exact, x, y) != dark(coarse, x, y);
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v) {
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u) {
                    alike = alike && dark(exact, u, v) == dark(exact, x, y);
                }
            }
            count += alike ? 1 : 0;
        }
    }
    return count;
}

} // namespace

TEST_F(HardDetail, NoError_IsTheFullModelToTheBitInEveryRenderer) {
    const scene::Scene scene = balls(chalk(), ballPlaces());
    render::Renderer plain(device(), scene);
    render::Renderer with_levels(device(), scene, {}, kLevels);
    for (const Renderer renderer :
         {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kClusteredDeferred,
          Renderer::kToonFragment, Renderer::kToonCompute}) {
        for (const GeometryPath path : paths()) {
            SCOPED_TRACE(testing::Message() << "renderer " << static_cast<int>(renderer) << " path "
                                            << static_cast<int>(path));
            render::FrameInputs inputs = seenFrom({1, 2, 5});
            inputs.settings.renderer = renderer;
            inputs.geometry = path;
            const Picture a = draw(plain, inputs);
            const Picture b = draw(with_levels, inputs);
            EXPECT_EQ(differingFloats(a, b), 0U);
            EXPECT_EQ(a.rgba8, b.rgba8);
        }
    }
}

// A closed dark surface before a bright background: nothing shines through, and nothing is farther
// from its place than the error. Near, where the eye is inside of meshlets' spheres, and far.
TEST_F(HardDetail, ClosedSurface_ShowsNoBackgroundFrom500Eyes) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(-1, 1);
    for (const glm::dmat4& place : ballPlaces()) {
        const scene::Scene scene = balls(ink(), {place});
        render::Renderer renderer(device(), scene, {}, kLevels);
        render::ViewRenderer view(renderer);
        for (int i = 0; i < 170; ++i) {
            const glm::dvec3 way =
                glm::normalize(glm::dvec3(share(random), share(random), share(random) + 1e-3));
            const bool parallel = i % 5 == 0;
            // What the near plane cuts has no outline to compare.
            const double distance = (parallel ? 5 : 1.5) + 12 * std::pow(share(random), 4);
            const float error_px = i % 2 == 0 ? 1.0F : 3.0F;
            const glm::dvec3 middle(place[3]);
            render::FrameInputs inputs = seenFrom(middle + way * distance);
            inputs.settings.camera =
                settings::lookAt(middle + way * distance, middle + way * 0.1, {0.1, 1, 0});
            if (parallel) {
                inputs.settings.camera.projection = settings::Projection::kOrthographic;
                inputs.settings.camera.half_height_m = 1.7;
            }
            inputs.geometry = paths()[static_cast<size_t>(i) % paths().size()];
            SCOPED_TRACE(testing::Message() << i << " path " << static_cast<int>(inputs.geometry));
            const Picture exact = drawPixels(view, inputs);
            inputs.settings.geometry_error_px = error_px;
            const Picture coarse = drawPixels(view, inputs);
            ASSERT_EQ(strayPixels(exact, coarse, static_cast<int>(error_px) + 1), 0U);
        }
    }
}

TEST_F(HardDetail, LargerErrors_DrawFewerTriangles) {
    const scene::Scene scene = balls(chalk(), ballPlaces());
    render::Renderer renderer(device(), scene, {}, kLevels);
    render::FrameInputs inputs = seenFrom({0.5, 1, 12});
    inputs.geometry = GeometryPath::kRaster; // where the host counts them
    uint32_t last = draw(renderer, inputs).stats.triangle_count;
    for (const float error_px : {0.1F, 0.5F, 2.0F}) {
        inputs.settings.geometry_error_px = error_px;
        const uint32_t count = draw(renderer, inputs).stats.triangle_count;
        EXPECT_LT(count, last) << error_px;
        EXPECT_GT(count, 0U);
        last = count;
    }
}

// The device chooses as the host does.
TEST_F(HardDetail, EveryPath_DrawsTheSameLevels) {
    const scene::Scene scene = balls(chalk(), ballPlaces());
    render::Renderer renderer(device(), scene, {}, kLevels);
    for (const double distance : {4.0, 7.0, 12.0}) {
        render::FrameInputs inputs = seenFrom(glm::dvec3(0.3, 0.2, 1) * distance, 2);
        inputs.settings.camera.lens_shift = {0.3, -0.2};
        inputs.geometry = GeometryPath::kRaster;
        const Picture meant = draw(renderer, inputs);
        inputs.settings.geometry_error_px = 0;
        const Picture exact = draw(renderer, inputs);
        inputs.settings.geometry_error_px = 2;
        for (const GeometryPath path : paths()) {
            SCOPED_TRACE(testing::Message() << distance << ' ' << static_cast<int>(path));
            inputs.geometry = path;
            const Picture drawn = draw(renderer, inputs);
            const auto apart = [&](const Picture& a) {
                size_t count = 0;
                for (size_t byte = 0; byte < a.rgba8.size(); ++byte) {
                    const int step = std::to_integer<int>(a.rgba8[byte]) -
                                     std::to_integer<int>(drawn.rgba8[byte]);
                    count += step > 2 || step < -2 ? 1U : 0U;
                }
                return count;
            };
            EXPECT_LE(apart(meant), drawn.rgba8.size() / 500);
            EXPECT_GT(apart(exact), 4 * apart(meant));
        }
    }
}

// Levels change while the camera moves: by no more than the surface may be off, which moves few
// pixels by much.
TEST_F(HardDetail, CameraThatMovesACentimetre_ChangesThePictureLittle) {
    const scene::Scene scene = balls(chalk(), ballPlaces());
    render::Renderer renderer(device(), scene, {}, kLevels);
    render::ViewRenderer view(renderer);
    const auto change = [&](double z, float error_px) {
        render::FrameInputs inputs = seenFrom({1, 1.5, z}, error_px);
        inputs.settings.lights.animate = false;
        const Picture before = drawPixels(view, inputs);
        inputs.settings.camera = settings::lookAt({1, 1.5, z - 0.01}, {0.8, 0, -0.4}, {0, 1, 0});
        const Picture after = drawPixels(view, inputs);
        double sum = 0;
        for (size_t i = 0; i < before.rgba8.size(); ++i) {
            const int step =
                std::to_integer<int>(before.rgba8[i]) - std::to_integer<int>(after.rgba8[i]);
            sum += step * step;
        }
        return std::sqrt(sum / static_cast<double>(before.rgba8.size()));
    };
    double most_exact = 0;
    double most = 0;
    for (double z = 3; z < 14; z *= 1.06) {
        most_exact = std::max(most_exact, change(z, 0));
        most = std::max(most, change(z, 1));
    }
    RecordProperty("most_exact", std::to_string(most_exact));
    RecordProperty("most", std::to_string(most));
    EXPECT_LE(most, 2 * most_exact);
}

TEST_F(HardDetail, CoarseTriangles_HaveNoNames) {
    const scene::Scene scene = balls(chalk(), ballPlaces());
    render::Renderer renderer(device(), scene, {}, kLevels);
    render::ViewRenderer view(renderer);
    for (const float error_px : {0.0F, 1.0F}) {
        render::FrameInputs inputs = seenFrom({1, 1, 6}, error_px);
        inputs.geometry = GeometryPath::kVisibility;
        (void)drawPixels(view, inputs);
        const auto visibility = view.readVisibility(scene);
        EXPECT_EQ(static_cast<bool>(visibility), error_px == 0);
        if (!visibility) {
            EXPECT_EQ(visibility.error().code, ErrorCode::kUnsupported);
        }
    }
}

} // namespace froxel::test
