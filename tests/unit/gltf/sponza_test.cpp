// Sponza as a whole; not part of the repository, so skipped where it is not there.
#include "gltf/gltf_loader.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace froxel::gltf {
namespace {

TEST(Sponza, Load_HasEverything) {
    const auto path = froxel::test::sponzaPath();
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no Sponza at " << path << "; set FROXEL_SPONZA to its .gltf file";
    }
    const Result<scene::Scene> result = load(path);
    ASSERT_TRUE(result.has_value()) << result.error().message;
    const scene::Scene& scene = *result;

    size_t triangle_count = 0;
    size_t placed_triangle_count = 0;
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            triangle_count += primitive.indices.size() / 3;
        }
    }
    for (const scene::Instance& instance : scene.instances) {
        for (const scene::Primitive& primitive : scene.meshes[instance.mesh].primitives) {
            placed_triangle_count += primitive.indices.size() / 3;
        }
    }
    RecordProperty("triangles", std::to_string(triangle_count));
    EXPECT_EQ(placed_triangle_count, 262'087U) << triangle_count;
    EXPECT_EQ(scene.instances.size(), 170U);
    EXPECT_EQ(scene.meshes.size(), 44U);
    EXPECT_EQ(scene.materials.size(), 24U);
    EXPECT_EQ(scene.images.size(), 35U);
    ASSERT_EQ(scene.cameras.size(), 4U);
    EXPECT_EQ(scene.cameras[0].name, "CameraMain");
    EXPECT_TRUE(scene.warnings.empty());
    for (const scene::Image& image : scene.images) {
        EXPECT_EQ(image.rgba8.size(), size_t{image.width_px} * image.height_px * 4) << image.name;
    }
}

} // namespace
} // namespace froxel::gltf
