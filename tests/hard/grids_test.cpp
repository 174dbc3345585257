// Grids, pictures and lists of every size; lights by number and reach.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <cmath>

namespace froxel::test {

namespace {

using glm::dvec3;
using settings::Renderer;

class HardGrids : public SharedGpuTest {
  protected:
    // A room seen from its front, 150 lights of 2 m.
    static render::FrameInputs roomInputs(const scene::Scene& scene) {
        auto inputs = hardInputs();
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.settings.lights.count = 150;
        inputs.time_s = 1.5;
        return inputs;
    }
};

// All seeded lights at one point.
void putSeededAt(render::FrameInputs& inputs, const dvec3& point) {
    inputs.settings.lights.box = BoundsD3{point, point};
}

} // namespace

// Case 6. One light of a millimetre above each pixel's own point 50 m away: none may fall between
// clusters.
TEST_F(HardGrids, TinyLights_EachLightsItsPixel) {
    auto maker = wallAhead(50);
    const double px = 2 * std::tan(glm::radians(30.0)) / 36 * 50;
    for (int y = 0; y < 36; ++y) {
        for (int x = 0; x < 64; ++x) {
            maker.point({(x - 31.5) * px, (17.5 - y) * px, -50 + 2e-4}, 1e-3F);
        }
    }
    render::Renderer renderer(device(), maker.scene);
    const auto pictures = expectExact(renderer, hardInputs(), Toon::kNo);
    EXPECT_EQ(litPixels(pictures.naive), 64U * 36U);
    EXPECT_GE(pictures.forward_plus.stats.lists.entry_count, 64U * 36U);
}

// Case 7. Lights that reach everything; and lists past their limit, which name all lights.
TEST_F(HardGrids, HugeLights_ListsAndOverflowAreExact) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = roomInputs(scene);
    inputs.settings.lights.count = 500;
    inputs.settings.lights.radius_m = 1e4F;
    inputs.settings.size = {32, 18};
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    const auto& lists = pictures.forward_plus.stats.lists;
    EXPECT_EQ(lists.entry_count, uint64_t{500} * (lists.cluster_count - lists.empty_count));
    EXPECT_FALSE(lists.overflowed);

    render::ViewRenderer tight(renderer, {.max_entries = 10'000});
    inputs.assignment = render::AssignmentPlace::kDevice;
    inputs.settings.renderer = Renderer::kForwardPlus;
    const Picture overflowed = draw(tight, inputs);
    EXPECT_TRUE(overflowed.stats.lists.overflowed);
    EXPECT_EQ(differingFloats(overflowed, pictures.naive), 0U);
}

// Case 8. A light of the file without a range.
TEST_F(HardGrids, NoRange_ReachesEverything) {
    auto maker = insideOfABox(30);
    maker.point({1, 2, 3}, 0, 100).point({0, 0, -20}, 2, 10).point({-25, 0, 25}, 0, 500);
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_EQ(litPixels(pictures.naive), 64U * 36U);
    const auto reference = refer(renderer, maker.scene, inputs);
    expectNoneMissing(maker.scene, inputs, reference.visibility);
    // No light is nearer to a surface than a sixth of its distance: see light_places_test.cpp.
    for (const auto& picture : {pictures.naive, drawByPlanes(renderer, inputs)}) {
        const auto worst = worstOf(picture, reference, within(200 * 0x1p-24, 0));
        EXPECT_LE(worst.ratio, 1) << worst;
    }
}

// Case 10. N equal terms in fp32 are off by at most N * 2^-24 of their sum, and each by itself by
// less than 100 * 2^-24.
TEST_F(HardGrids, FiveThousandAtOnePoint_SumAsDoublePrecisionDoes) {
    const auto maker = wallAhead(3);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {48, 27};
    inputs.settings.lights.count = 5000;
    putSeededAt(inputs, {0.25, -0.125, -2});
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    const auto reference = refer(renderer, maker.scene, inputs);
    const auto worst = worstOf(pictures.naive, reference, within(5100 * 0x1p-24, 1e-5));
    EXPECT_LE(worst.ratio, 1) << worst;
    EXPECT_EQ(pictures.forward_plus.stats.lists.largest, 5000U);
}

// Case 11. Lists about every width that somebody packed a count or an index in.
TEST_F(HardGrids, ListsAboutPowersOfTwo_NeitherWrapNorDrop) {
    const auto maker = wallAhead(3);
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    auto inputs = hardInputs();
    inputs.settings.size = {16, 16};
    putSeededAt(inputs, {0.25, -0.125, -2.5});
    for (const uint32_t count : {255U, 256U, 257U, 511U, 512U, 513U, 1023U, 1025U}) {
        SCOPED_TRACE(count);
        inputs.settings.lights.count = count;
        const auto pictures = expectExact(view, inputs, Toon::kNo);
        EXPECT_EQ(pictures.forward_plus.stats.lists.largest, count);
    }
}

TEST_F(HardGrids, ListsAbout65536_NeitherWrapNorDrop) {
    const auto maker = wallAhead(3);
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    auto inputs = hardInputs();
    inputs.settings.size = {16, 16};
    inputs.settings.grid.size = {1, 1, 1};
    putSeededAt(inputs, {0.25, -0.125, -2.5});
    float before = 0;
    for (const uint32_t count : {65'535U, 65'536U, 65'537U}) {
        SCOPED_TRACE(count);
        inputs.settings.lights.count = count;
        inputs.settings.renderer = Renderer::kNaive;
        const Picture naive = draw(view, inputs);
        inputs.settings.renderer = Renderer::kForwardPlus;
        const Picture lists = draw(view, inputs);
        EXPECT_EQ(differingFloats(naive, lists), 0U);
        EXPECT_EQ(lists.stats.lists.largest, count);
        EXPECT_GT(largest(lists), before); // one more adds something
        before = largest(lists);
    }
}

// Case 14. Rims that all lie on the line between two tiles: a cut-off would be seen there.
TEST_F(HardGrids, SixtyFourRimsOnATileBorder_LeaveNoStep) {
    auto maker = wallAhead(4);
    for (int i = 0; i < 64; ++i) {
        // The plane between tiles 7 and 8 is x = 0: each lights a disc of the wall that touches it.
        const double away = 0.5 + 0.02 * i;
        maker.point({i % 2 == 0 ? away : -away, -2.0 + i / 16.0, -3.5},
                    static_cast<float>(std::hypot(away, 0.5)));
    }
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(litPixels(pictures.naive), 100U);
    expectNoneMissing(maker.scene, inputs, refer(renderer, maker.scene, inputs).visibility);
}

// Case 18. One slice, one tile, tiles of part of a pixel; pictures of one pixel up.
TEST_F(HardGrids, SmallestGridsAndPictures_AreExact) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = roomInputs(scene);
    const std::pair<settings::Size, settings::GridSize> cases[] = {
        {{1, 1}, {1, 1, 1}},      {{1, 1}, {16, 9, 24}},  {{1, 7}, {128, 128, 256}},
        {{17, 33}, {1, 1, 24}},   {{17, 33}, {16, 9, 1}}, {{17, 33}, {17, 33, 2}},
        {{64, 3}, {128, 128, 1}}, {{33, 17}, {5, 7, 3}}};
    for (const auto& [size, grid] : cases) {
        SCOPED_TRACE(std::to_string(size.width_px) + "x" + std::to_string(size.height_px));
        inputs.settings.size = size;
        inputs.settings.grid.size = grid;
        const auto pictures = expectExact(view, inputs, Toon::kNo);
        EXPECT_EQ(pictures.naive.radiance.size(), size_t{3} * size.width_px * size.height_px);
    }
}

TEST_F(HardGrids, OddFullSize_IsExact) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = roomInputs(scene);
    inputs.settings.size = {1919, 1079};
    inputs.settings.lights.count = 20;
    (void)expectExact(renderer, inputs, Toon::kNo);
}

// Case 20. Rays are parallel; the near plane may be the eye's own.
TEST_F(HardGrids, Orthographic_IsExactAndAsDoublePrecisionHasIt) {
    auto maker = insideOfABox(4);
    maker.point({0, 0, 0.5}, 2).point({1, 1, 0}, 3).point({-2, 0, -3.5}, 2).point({3, -1, 6}, 9);
    maker.spot({1, 0, 1}, {-0.2, 0.1, -1}, 8, 5, 30);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.camera.projection = settings::Projection::kOrthographic;
    inputs.settings.camera.half_height_m = 3;
    for (const double near_m : {0.0, 1e-3, 2.0}) {
        SCOPED_TRACE(near_m);
        inputs.settings.camera.near_m = near_m;
        const auto pictures = expectExact(renderer, inputs);
        EXPECT_GT(litPixels(pictures.naive), 200U);
        // A depth of the range 0..1 over 8 m is off by 2^-24 of that, a metre from a light.
        const auto reference = refer(renderer, maker.scene, inputs);
        for (const auto& picture : {pictures.naive, drawByPlanes(renderer, inputs)}) {
            const auto worst = worstOf(picture, reference, within(1e-5, 1e-5));
            EXPECT_LE(worst.ratio, 1) << worst;
        }
    }
}

// Case 21. Frusta that do not hold their own axis.
TEST_F(HardGrids, OffCentreFrusta_AreExactAndAsDoublePrecisionHasThem) {
    auto maker = insideOfABox(4);
    for (int i = 0; i < 20; ++i) {
        maker.point({3.0 * std::sin(i), 3.0 * std::cos(2.0 * i), -3.0 * std::sin(3.0 * i)}, 2.5F);
    }
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    for (const glm::dvec2 shift : {glm::dvec2(0.7, -0.4), {-1.5, 0}, {3, 2.5}, {0, -6}}) {
        SCOPED_TRACE(shift.x);
        inputs.settings.camera.lens_shift = shift;
        const auto pictures = expectExact(renderer, inputs, Toon::kNo);
        const auto reference = refer(renderer, maker.scene, inputs);
        expectNoneMissing(maker.scene, inputs, reference.visibility);
        for (const auto& picture : {pictures.naive, drawByPlanes(renderer, inputs)}) {
            const auto worst = worstOf(picture, reference, within(1e-4, 1e-6));
            EXPECT_LE(worst.ratio, 1) << worst;
        }
    }
}

} // namespace froxel::test
