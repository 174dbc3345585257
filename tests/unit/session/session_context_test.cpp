#include "session/session_context.h"
#include "settings/ranges.h"

#include <gtest/gtest.h>

#include <array>

namespace froxel::session {
namespace {

TEST(Summarize, Nodes_AreThoseThatPlaceInstances) {
    scene::Scene scene;
    scene.meshes.resize(1);
    const auto place = [&scene](const char* name, uint32_t node) {
        scene.instances.push_back({0, glm::dmat4(1), name, node});
    };
    place("crowd", 7);
    place("crowd", 7);
    place("crowd", 8); // another of the same name
    place("built in", scene::kNone);
    place("built in", scene::kNone);
    const SceneSummary summary = summarize(scene);
    ASSERT_EQ(summary.nodes.size(), 4U);
    const std::array<uint32_t, 4> firsts = {0, 2, 3, 4};
    const std::array<uint32_t, 4> nodes = {7, 8, scene::kNone, scene::kNone};
    for (size_t i = 0; i < firsts.size(); ++i) {
        EXPECT_EQ(summary.nodes[i].first_instance, firsts[i]);
        EXPECT_EQ(summary.nodes[i].node, nodes[i]);
    }
    EXPECT_EQ(summary.nodes[1].name, "crowd");
}

TEST(Summarize, Instances_AreCountedEach) {
    scene::Scene scene;
    scene.name = "two";
    scene.materials.resize(3);
    scene.textures.resize(2);
    scene.lights.resize(1);
    scene::Primitive two_triangles;
    two_triangles.indices = {0, 1, 2, 2, 1, 3};
    scene::Primitive one_triangle;
    one_triangle.indices = {0, 1, 2};
    scene.meshes.push_back({"pair", {two_triangles, one_triangle}});
    scene.meshes.push_back({"unused", {one_triangle}});
    scene.instances.resize(4);
    scene.cameras.push_back({"door", {}});
    scene.bounds_world.add(glm::dvec3(1, 2, 3));
    scene.warnings = {{"NO_SCENE", scene::Severity::kInformation, "", "no scene"}};
    scene.warnings_left_out = 4;

    const SceneSummary summary = summarize(scene);
    EXPECT_EQ(summary.name, "two");
    EXPECT_EQ(summary.triangle_count, 12U);
    EXPECT_EQ(summary.draw_count, 8U);
    EXPECT_EQ(summary.material_count, 3U);
    EXPECT_EQ(summary.texture_count, 2U);
    EXPECT_EQ(summary.punctual_light_count, 1U);
    EXPECT_EQ(summary.cameras.front().name, "door");
    EXPECT_EQ(summary.bounds_world.min, glm::dvec3(1, 2, 3));
    EXPECT_EQ(summary.warnings, scene.warnings);
    EXPECT_EQ(summary.warnings_left_out, 4U);
}

TEST(DefaultsFor, BothKinds_AreWithinTheRanges) {
    for (const DeviceKind kind : {DeviceKind::kCpu, DeviceKind::kGpu}) {
        const SessionDefaults defaults = defaultsFor(kind);
        EXPECT_TRUE(settings::kWidthRange.contains(defaults.settings.size.width_px));
        EXPECT_TRUE(settings::kHeightRange.contains(defaults.settings.size.height_px));
        EXPECT_TRUE(settings::kQualityRange.contains(defaults.encoding.quality));
        EXPECT_LE(uint64_t{defaults.settings.size.width_px} * defaults.settings.size.height_px,
                  defaults.max_area_px);
        EXPECT_LE(defaults.max_area_px, uint64_t{4096} * 4096);
    }
}

} // namespace
} // namespace froxel::session
