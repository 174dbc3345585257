// Bloom of every kind against the same sums in double, and what it promises: a constant picture
// stays as it is, light is moved and not made, a pixel that moves does not flicker.
#include "render/steps/bloom_plan.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace froxel::test {

namespace {

using settings::BloomKind;
using settings::Renderer;

constexpr std::array kKinds = {BloomKind::kSinglePass, BloomKind::kSeparable, BloomKind::kATrous,
                               BloomKind::kMipChain};

std::string nameOf(BloomKind kind) {
    return std::string(settings::kBloomKindNames[static_cast<size_t>(kind)]);
}

class Bloom : public SharedGpuTest {};

render::FrameInputs inputsFor(const settings::Camera& camera, const settings::Size& size) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = size;
    inputs.settings.lights.count = 40;
    inputs.time_s = 1.5;
    return inputs;
}

// A picture in double. Beyond its borders it is mirrored.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> colors;

    Plane(int w, int h) : width(w), height(h), colors(static_cast<size_t>(w * h)) {}
    static int inside(int at, int size) {
        at = at < 0 ? -1 - at : at;
        return at < size ? at : 2 * size - 1 - at;
    }
    [[nodiscard]] const glm::dvec3& at(int x, int y) const {
        return colors[static_cast<size_t>(inside(y, height) * width + inside(x, width))];
    }
    template <class Function>
    static Plane make(int w, int h, Function color) {
        Plane plane(w, h);
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                plane.colors[static_cast<size_t>(y * w + x)] = color(x, y);
            }
        }
        return plane;
    }
    // Of taps first, first + step, ... along either axis, around `place(x)`.
    template <class Place>
    [[nodiscard]] Plane gathered(
        int w, int h, const std::vector<double>& weights, int first, int step, Place place) const {
        return make(w, h, [&](int x, int y) {
            glm::dvec3 sum(0);
            for (size_t j = 0; j < weights.size(); ++j) {
                for (size_t i = 0; i < weights.size(); ++i) {
                    sum += weights[i] * weights[j] *
                           at(place(x) + first + step * static_cast<int>(i),
                              place(y) + first + step * static_cast<int>(j));
                }
            }
            return sum;
        });
    }
};

Plane mix(const Plane& a, const Plane& b, double share) {
    return Plane::make(a.width, a.height,
                       [&](int x, int y) { return glm::mix(a.at(x, y), b.at(x, y), share); });
}

int itself(int x) {
    return x;
}

Plane gaussian(const Plane& bright, double sigma) {
    const int reach = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> weights;
    for (int k = -reach; k <= reach; ++k) {
        weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) {
        weight /= sum;
    }
    return bright.gathered(bright.width, bright.height, weights, -reach, 1, itself);
}

// Variances of 1, 5, 21, ... square pixels.
Plane aTrous(const Plane& bright, double sigma) {
    Plane now = bright;
    double variance = 0;
    for (int hole = 1; variance < sigma * sigma; hole *= 2) {
        const double next = variance + hole * hole;
        const Plane wider =
            now.gathered(now.width, now.height, {1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0},
                         -2 * hole, hole, itself);
        now = mix(now, wider, std::min(1.0, (sigma * sigma - variance) / (next - variance)));
        variance = next;
    }
    return now;
}

Plane twice(const Plane& small, int width, int height) {
    return Plane::make(width, height, [&](int x, int y) {
        const auto other = [](int at) { return at % 2 == 0 ? at / 2 - 1 : at / 2 + 1; };
        return 0.5625 * small.at(x / 2, y / 2) +
               0.1875 * (small.at(other(x), y / 2) + small.at(x / 2, other(y))) +
               0.0625 * small.at(other(x), other(y));
    });
}

// Variances of 1.5, 7.5, 31.5, ... square pixels.
Plane mipChain(const Plane& fine, double variance, double scale) {
    const Plane coarse =
        fine.gathered((fine.width + 1) / 2, (fine.height + 1) / 2,
                      {1 / 8.0, 3 / 8.0, 3 / 8.0, 1 / 8.0}, -1, 1, [](int x) { return 2 * x; });
    const double here = 1.5 * scale;
    if (variance <= here) {
        return mix(fine, twice(coarse, fine.width, fine.height), variance / here);
    }
    return twice(mipChain(coarse, variance - here, 4 * scale), fine.width, fine.height);
}

glm::dvec3 brightOf(const glm::dvec3& color, double threshold, double knee) {
    const double peak = std::max({color.x, color.y, color.z});
    const double over = std::clamp(peak - threshold + knee, 0.0, 2 * knee);
    const double soft = knee > 0 ? over * over / (4 * knee) : 0;
    return peak > 0 ? color * (std::max({soft, peak - threshold, 0.0}) / peak) : glm::dvec3(0);
}

Plane planeOf(const Picture& picture) {
    const auto width = static_cast<int>(picture.width_px);
    return Plane::make(width, static_cast<int>(picture.height_px), [&](int x, int y) {
        const float* rgb = &picture.radiance[static_cast<size_t>(y * width + x) * 3];
        return glm::dvec3(rgb[0], rgb[1], rgb[2]);
    });
}

Plane expected(const Plane& picture, const settings::Bloom& bloom, double exposure) {
    const double threshold = static_cast<double>(bloom.threshold) / exposure;
    const double knee = threshold * static_cast<double>(bloom.knee);
    const double sigma =
        static_cast<double>(bloom.radius) * std::min(picture.width, picture.height);
    const Plane bright = Plane::make(picture.width, picture.height, [&](int x, int y) {
        return brightOf(picture.at(x, y), threshold, knee);
    });
    const Plane spread = bloom.kind == BloomKind::kATrous     ? aTrous(bright, sigma)
                         : bloom.kind == BloomKind::kMipChain ? mipChain(bright, sigma * sigma, 1)
                                                              : gaussian(bright, sigma);
    return Plane::make(picture.width, picture.height, [&](int x, int y) {
        return picture.at(x, y) +
               static_cast<double>(bloom.strength) * (spread.at(x, y) - bright.at(x, y));
    });
}

double largest(const Plane& plane) {
    double most = 0;
    for (const auto& color : plane.colors) {
        most = std::max({most, color.x, color.y, color.z});
    }
    return most;
}

double largestDifference(const Plane& a, const Plane& b) {
    double most = 0;
    for (size_t i = 0; i < a.colors.size(); ++i) {
        const glm::dvec3 off = glm::abs(a.colors[i] - b.colors[i]);
        most = std::max({most, off.x, off.y, off.z});
    }
    return most;
}

double sumOf(const Plane& plane) {
    const auto sum = std::accumulate(plane.colors.begin(), plane.colors.end(), glm::dvec3(0));
    return sum.x + sum.y + sum.z;
}

// Sums of a few hundred products in fp32, of values up to the brightest.
constexpr double kRounding = 1e-5;

} // namespace

// Odd sides, so that every level of the chain ends in half a pixel; from less than a pixel to all
// that the chain has levels for.
TEST_F(Bloom, EveryKind_AgainstDouble_IsWithinRounding) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, {81, 45});
    inputs.settings.exposure = 2;
    const Plane before = planeOf(draw(view, inputs));
    for (const auto kind : kKinds) {
        for (const float radius : {0.01F, 0.03F, 0.05F}) {
            SCOPED_TRACE(nameOf(kind) + " " + std::to_string(radius));
            inputs.settings.bloom = {kind, 0.6F, 0.5F, 0.7F, radius};
            const Plane after = planeOf(draw(view, inputs));
            const Plane right = expected(before, inputs.settings.bloom, 2);
            EXPECT_LT(largestDifference(after, right), kRounding * largest(before));
            EXPECT_GT(largestDifference(after, before), 0.01 * largest(before));
        }
    }
}

// Glass is in the picture: it glows as the rest does.
TEST_F(Bloom, EveryRenderer_IsOfItsOwnPicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        SCOPED_TRACE(settings::kRendererNames[kind]);
        auto inputs = inputsFor(scene.cameras[0].camera, {64, 36});
        inputs.settings.renderer = static_cast<Renderer>(kind);
        const Plane before = planeOf(draw(view, inputs));
        inputs.settings.bloom = {BloomKind::kMipChain, 0.25F, 1.0F, 0.5F, 0.05F};
        const Plane after = planeOf(draw(view, inputs));
        EXPECT_LT(largestDifference(after, expected(before, inputs.settings.bloom, 1)),
                  kRounding * largest(before));
    }
}

TEST_F(Bloom, ConstantPicture_WithoutAThreshold_StaysAsItIs) {
    SceneMaker wall = wallAhead(3);
    wall.scene.materials[0].emissive = glm::vec3(0.1F, 0.2F, 0.4F);
    render::Renderer renderer(device(), wall.scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor({}, {97, 55});
    inputs.settings.lights.count = 0;
    inputs.settings.lights.ambient = 0;
    const Picture before = draw(view, inputs);
    for (const auto kind : kKinds) {
        SCOPED_TRACE(nameOf(kind));
        inputs.settings.bloom = {kind, 0, 0.5F, 1, 0.05F};
        const Picture after = draw(view, inputs);
        EXPECT_LT(largestDifference(planeOf(after), planeOf(before)),
                  5e-6 * largest(planeOf(before)));
        EXPECT_EQ(after.rgba8, before.rgba8);
    }
}

// A pixel 500 times as bright as white that walks over the picture, out of its corner, too. Its
// light may go to other pixels, but there is as much of it, wherever it stands; and the glow around
// it, which the chain draws on a coarser grid, changes by at most 13 % from step to step.
TEST_F(Bloom, SinglePixelThatMoves_DoesNotFlicker) {
    SceneMaker maker;
    scene::Material lamp = chalk();
    lamp.emissive = glm::vec3(500);
    maker.add(quad({0, 0, -5}, {1, 0, 0}, {0, 1, 0}, 1, maker.add(lamp)));
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    for (const auto kind : kKinds) {
        SCOPED_TRACE(nameOf(kind));
        double first_sum = 0;
        double last_glow = 0;
        for (int step = 0; step <= 16; ++step) {
            settings::Camera camera;
            camera.projection = settings::Projection::kOrthographic;
            camera.half_height_m = 32; // a pixel a metre
            camera.eye_world = {16 + step, 16, 0};
            auto inputs = inputsFor(camera, {64, 64});
            inputs.settings.lights.count = 0;
            inputs.settings.bloom = {kind, 1, 0, 0.5F, 0.05F};
            const Plane lit = planeOf(draw(view, inputs));
            const auto x = 32 - 16 - step;
            const auto y = 32 + 16 - 1;
            ASSERT_GT(lit.at(x, y).x, 240) << step; // it is this pixel and no other
            const double sum = sumOf(lit);
            first_sum = step == 0 ? sum : first_sum;
            EXPECT_NEAR(sum, first_sum, 1e-4 * first_sum) << step;
            const double glow = lit.at(x + 1, y).x;
            if (step > 0 && step < 14) { // at the border it is mirrored
                EXPECT_NEAR(glow, last_glow, 0.15 * std::max(glow, last_glow)) << step;
            }
            last_glow = glow;
        }
    }
}

TEST_F(Bloom, Off_HasNoPictureAndNoPass) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, {64, 36});
    const Picture before = draw(view, inputs);
    EXPECT_FALSE(hasPass(before, "bloom"));
    inputs.settings.bloom.kind = BloomKind::kMipChain;
    EXPECT_TRUE(hasPass(draw(view, inputs), "bloom"));
    EXPECT_TRUE(device().memoryLedger()->byPurpose().contains("bloom"));
    inputs.settings.bloom.strength = 0;
    const Picture after = draw(view, inputs);
    EXPECT_FALSE(hasPass(after, "bloom"));
    EXPECT_FALSE(device().memoryLedger()->byPurpose().contains("bloom"));
    EXPECT_EQ(differingFloats(before, after), 0U);
    EXPECT_EQ(before.rgba8, after.rgba8);
}

TEST_F(Bloom, KernelOfMoreTapsThanTheDevicesLoopsHave_IsRefusedInOneLine) {
    const scene::Scene nothing;
    render::Renderer renderer(device(), nothing);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor({}, {1920, 1080});
    inputs.settings.bloom = {BloomKind::kSinglePass, 1, 0.5F, 0.5F, 0.05F};
    const auto refused = view.submit(inputs);
    if (onGpu()) {
        EXPECT_TRUE(refused);
        return;
    }
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
    EXPECT_THAT(refused.error().message, ::testing::StartsWith("bloom takes "));
}

} // namespace froxel::test
