#include "scene/stacked_layers.h"

#include <gtest/gtest.h>

namespace froxel::scene {
namespace {

// `count` unit squares, each so far above the one before.
Scene squares(uint32_t count, float apart_m) {
    Primitive primitive;
    for (uint32_t i = 0; i < count; ++i) {
        const float z = apart_m * static_cast<float>(i);
        primitive.positions.insert(primitive.positions.end(),
                                   {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}});
        for (const uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            primitive.indices.push_back(4 * i + corner);
        }
    }
    Scene scene;
    scene.meshes.push_back({"squares", {primitive}});
    scene.instances.push_back({});
    return scene;
}

TEST(StackedLayers, AreCountedExactlyInSmallScenes) {
    EXPECT_EQ(stackedLayers(Scene()), 0U);
    EXPECT_EQ(stackedLayers(squares(1, 0)), 1U);
    EXPECT_EQ(stackedLayers(squares(500, 0)), 500U);
    EXPECT_EQ(stackedLayers(squares(500, 10)), 500U);
}

TEST(StackedLayers, OfInstancesAddUp) {
    Scene scene = squares(10, 0.1F);
    scene.instances.resize(300);
    EXPECT_EQ(stackedLayers(scene), 3000U);
}

TEST(StackedLayers, AreEstimatedInLargeScenes) {
    const uint64_t layers = stackedLayers(squares(400'000, 0));
    EXPECT_GT(layers, 350'000U);
    EXPECT_LT(layers, 450'000U);
}

// A plane of a million triangles, which no line meets twice.
TEST(StackedLayers, APlaneHasOne_HoweverFine) {
    Scene scene = squares(1, 0);
    for (int i = 0; i < 500'000; ++i) {
        Instance instance;
        instance.world_from_object[3] = glm::dvec4(1.5 * (i % 1000), 1.5 * (i / 1000), 0, 1);
        scene.instances.push_back(instance);
    }
    EXPECT_LT(stackedLayers(scene), 8U);
}

} // namespace
} // namespace froxel::scene
