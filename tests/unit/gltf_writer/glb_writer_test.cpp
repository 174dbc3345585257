#include "builtin_scene/hall.h"
#include "gltf_writer/glb_writer.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <png.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <string>
#include <vector>

namespace froxel::gltf_writer {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// The validator's run names a folder in which the files stay.
std::filesystem::path fileNamed(const std::string& name) {
    const char* folder = std::getenv("FROXEL_GLB_FOLDER");
    return std::filesystem::path(folder != nullptr ? folder : testing::TempDir()) / name;
}

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

uint32_t wordAt(const std::string& bytes, size_t offset) {
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

struct Glb {
    json document;
    std::string bin;
};

// Takes the container apart, checking every length on the way.
Glb takeApart(const std::string& bytes) {
    Glb glb;
    EXPECT_GE(bytes.size(), 20U);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(wordAt(bytes, 4), 2U);
    EXPECT_EQ(wordAt(bytes, 8), bytes.size());
    const size_t json_size = wordAt(bytes, 12);
    EXPECT_EQ(json_size % 4, 0U);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    glb.document = json::parse(bytes.substr(20, json_size));
    if (20 + json_size < bytes.size()) {
        EXPECT_EQ(wordAt(bytes, 20 + json_size) + json_size + 28, bytes.size());
        EXPECT_EQ(bytes.substr(24 + json_size, 4), std::string("BIN\0", 4));
        glb.bin = bytes.substr(28 + json_size);
    }
    return glb;
}

Glb written(const scene::Scene& scene, const std::string& name) {
    const auto path = fileNamed(name);
    const auto result = writeGlb(scene, path);
    EXPECT_FALSE(result.has_error()) << result.error().message;
    return takeApart(bytesOf(path));
}

scene::Image twoByTwo(const char* name, uint8_t alpha) {
    scene::Image image{name, 2, 2, {}};
    for (const int value : {255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 8, 7}) {
        image.rgba8.own().push_back(static_cast<std::byte>(value));
        if (image.rgba8.size() % 4 == 3) {
            image.rgba8.own().push_back(static_cast<std::byte>(alpha));
        }
    }
    return image;
}

scene::Primitive triangle() {
    scene::Primitive primitive;
    primitive.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, -1}};
    primitive.normals.assign(3, glm::normalize(glm::vec3(0, 1, 3)));
    primitive.uv0 = {{0, 0}, {1, 0}, {0, 1}};
    primitive.indices = {0, 1, 2};
    return primitive;
}

// They use three textures.
std::vector<scene::Material> everyMaterial() {
    scene::Material rich;
    rich.name = "rich";
    rich.base_color = {0.25F, 0.5F, 0.75F, 1};
    rich.emissive = {4, 2, 1};
    rich.alpha_mode = scene::AlphaMode::kMask;
    rich.alpha_cutoff = 0.25F;
    rich.double_sided = true;
    rich.base_color_texture = {1, 0, {0.5F, 0.25F}, 0.75F, {2, 3}};
    rich.metallic_roughness_texture = {0, 1};
    rich.normal_texture = {2};
    rich.normal_scale = 0.5F;
    rich.occlusion_texture = {0};
    rich.occlusion_strength = 0.5F;
    rich.emissive_texture = {0};
    scene::Material flat;
    flat.unlit = true;
    flat.alpha_mode = scene::AlphaMode::kBlend;
    scene::Material glass;
    glass.ior = 2;
    glass.specular = 0.5F;
    glass.specular_color = {1, 0.5F, 2};
    glass.specular_texture = {1};
    glass.specular_color_texture = {0};
    glass.coat.strength = 0.5F;
    glass.coat.roughness = 0.25F;
    glass.coat_texture = {1};
    glass.coat_roughness_texture = {0, 1};
    glass.coat_normal_texture = {2};
    glass.coat.normal_scale = 2;
    glass.sheen = {.color = {1, 0.5F, 0.25F}, .roughness = 0.5F};
    glass.sheen_color_texture = {0};
    glass.anisotropy = {.strength = 0.5F, .rotation_rad = -2};
    glass.anisotropy_texture = {1};
    glass.film = {.strength = 0.5F, .ior = 1.5F, .least_nm = 50, .most_nm = 500};
    glass.film_texture = {1};
    glass.film_thickness_texture = {0};
    glass.sheen_roughness_texture = {1};
    scene::Material glossy;
    glossy.metallic = 0;
    glossy.roughness = 0.25F;
    glossy.ior = 0;
    glossy.specular_color = {0.5F, 0.25F, 1};
    glossy.specular_color_texture = {0};
    glossy.glossiness_texture = true;
    return {rich, flat, glass, glossy};
}

// One of everything that a scene can hold.
scene::Scene everything() {
    scene::Scene scene;
    scene.name = "Everything";
    scene.images = {twoByTwo("opaque", 255), twoByTwo("veiled", 128)};
    scene.samplers = {{},
                      {scene::Wrap::kClampToEdge, scene::Wrap::kMirroredRepeat,
                       scene::Filter::kNearest, scene::Filter::kNearest, scene::Filter::kNearest,
                       false}};
    scene.textures = {{0, 0}, {1, 1}, {0, scene::kNone}};
    scene.materials = everyMaterial();
    scene::Primitive full = triangle();
    full.uv1 = {{0, 0}, {0.5F, 0}, {0, 0.5F}};
    full.colors.assign(3, {1, 0.5F, 0.25F, 1});
    full.tangents.assign(3, {1, 0, 0, 1});
    scene::Primitive plain = triangle();
    plain.material = 1;
    scene.meshes = {{"mesh", {full, plain}}};
    glm::dmat4 mirrored(1.0);
    mirrored[0].x = -2;
    mirrored[3] = {1, 2, 3, 1};
    glm::dmat4 shifted(1.0);
    shifted[3] = {0, 5, 0, 1};
    scene.instances = {{0, glm::dmat4(1.0), "here"}, {0, mirrored, "mirror"}, {0, shifted, ""}};
    settings::Camera flat_camera = settings::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
    flat_camera.projection = settings::Projection::kOrthographic;
    scene.cameras = {{"front", settings::lookAt({1, 2, 5}, {0, 0, 0}, {0, 1, 0})},
                     {"flat", flat_camera}};
    scene::PunctualLight point;
    point.range_m = 7;
    scene::PunctualLight spot;
    spot.name = "spot";
    spot.type = scene::LightType::kSpot;
    spot.direction_world = {0, -1, 0};
    scene::PunctualLight sun;
    sun.type = scene::LightType::kDirectional;
    scene.lights = {point, spot, sun};
    scene.bounds_world.add(glm::dvec3(-3, 0, -1));
    scene.bounds_world.add(glm::dvec3(3, 8, 3));
    return scene;
}

TEST(GlbWriter, Everything_ReadsBackAsWritten) {
    const Glb glb = written(everything(), "everything.glb");
    const json& d = glb.document;
    EXPECT_EQ(d["asset"]["version"], "2.0");
    EXPECT_EQ(
        d["extensionsUsed"],
        json({"KHR_lights_punctual", "KHR_materials_anisotropy", "KHR_materials_clearcoat",
              "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_iridescence",
              "KHR_materials_pbrSpecularGlossiness", "KHR_materials_sheen",
              "KHR_materials_specular", "KHR_materials_unlit", "KHR_texture_transform"}));
    // The chunk is padded to a multiple of four.
    EXPECT_EQ((d["buffers"][0]["byteLength"].get<size_t>() + 3) / 4 * 4, glb.bin.size());

    const json& rich = d["materials"][0];
    EXPECT_EQ(rich["emissiveFactor"], json({1.0, 0.5, 0.25}));
    EXPECT_EQ(rich["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 4.0);
    EXPECT_EQ(rich["alphaMode"], "MASK");
    EXPECT_EQ(rich["alphaCutoff"], 0.25);
    EXPECT_EQ(rich["doubleSided"], true);
    const json& slot = rich["pbrMetallicRoughness"]["baseColorTexture"];
    EXPECT_EQ(slot["index"], 1);
    EXPECT_EQ(slot["extensions"]["KHR_texture_transform"],
              json({{"offset", {0.5, 0.25}}, {"rotation", 0.75}, {"scale", {2.0, 3.0}}}));
    EXPECT_EQ(rich["pbrMetallicRoughness"]["metallicRoughnessTexture"]["texCoord"], 1);
    EXPECT_EQ(d["materials"][1]["alphaMode"], "BLEND");
    EXPECT_TRUE(d["materials"][1]["extensions"].contains("KHR_materials_unlit"));
    const json& glass = d["materials"][2]["extensions"];
    EXPECT_EQ(glass["KHR_materials_ior"], json({{"ior", 2.0}}));
    EXPECT_EQ(glass["KHR_materials_specular"], json({{"specularFactor", 0.5},
                                                     {"specularColorFactor", {1.0, 0.5, 2.0}},
                                                     {"specularTexture", {{"index", 1}}},
                                                     {"specularColorTexture", {{"index", 0}}}}));
    EXPECT_EQ(d["materials"][3]["extensions"],
              json({{"KHR_materials_pbrSpecularGlossiness",
                     {{"diffuseFactor", {1.0, 1.0, 1.0, 1.0}},
                      {"specularFactor", {0.5, 0.25, 1.0}},
                      {"glossinessFactor", 0.75},
                      {"specularGlossinessTexture", {{"index", 0}}}}}}));
    EXPECT_EQ(d["samplers"][0]["minFilter"], 9987);
    EXPECT_EQ(d["samplers"][1]["minFilter"], 9728);
    EXPECT_EQ(d["samplers"][1]["wrapS"], 33071);
    EXPECT_EQ(d["samplers"][1]["wrapT"], 33648);
    EXPECT_FALSE(d["textures"][2].contains("sampler"));

    ASSERT_EQ(d["nodes"].size(), 8U);
    EXPECT_FALSE(d["nodes"][0].contains("matrix"));
    EXPECT_EQ(d["nodes"][1]["matrix"], json({-2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
                                             0.0, 1.0, 2.0, 3.0, 1.0}));
    EXPECT_EQ(d["nodes"][2]["translation"], json({0.0, 5.0, 0.0}));
    EXPECT_EQ(d["cameras"][1]["type"], "orthographic");
    EXPECT_EQ(d["extensions"]["KHR_lights_punctual"]["lights"][1]["type"], "spot");
    // The spot shines down: its node's -Z is -Y, so its third column is +Y.
    EXPECT_NEAR(d["nodes"][6]["matrix"][9].get<double>(), 1.0, 1e-12);
}

TEST(GlbWriter, Layers_ReadBackAsWritten) {
    const Glb glb = written(everything(), "layers.glb");
    const json& glass = glb.document["materials"][2]["extensions"];
    EXPECT_EQ(glass["KHR_materials_clearcoat"],
              json({{"clearcoatFactor", 0.5},
                    {"clearcoatRoughnessFactor", 0.25},
                    {"clearcoatTexture", {{"index", 1}}},
                    {"clearcoatRoughnessTexture", {{"index", 0}, {"texCoord", 1}}},
                    {"clearcoatNormalTexture", {{"index", 2}, {"scale", 2.0}}}}));
    EXPECT_EQ(glass["KHR_materials_anisotropy"], json({{"anisotropyStrength", 0.5},
                                                       {"anisotropyRotation", -2.0},
                                                       {"anisotropyTexture", {{"index", 1}}}}));
    EXPECT_EQ(glass["KHR_materials_iridescence"],
              json({{"iridescenceFactor", 0.5},
                    {"iridescenceIor", 1.5},
                    {"iridescenceThicknessMinimum", 50.0},
                    {"iridescenceThicknessMaximum", 500.0},
                    {"iridescenceTexture", {{"index", 1}}},
                    {"iridescenceThicknessTexture", {{"index", 0}}}}));
    EXPECT_EQ(glass["KHR_materials_sheen"], json({{"sheenColorFactor", {1.0, 0.5, 0.25}},
                                                  {"sheenRoughnessFactor", 0.5},
                                                  {"sheenColorTexture", {{"index", 0}}},
                                                  {"sheenRoughnessTexture", {{"index", 1}}}}));
}

TEST(GlbWriter, Positions_AreInTheBufferWithTheirBounds) {
    const Glb glb = written(everything(), "positions.glb");
    const json& d = glb.document;
    const json& primitive = d["meshes"][0]["primitives"][0];
    const json& accessor = d["accessors"][primitive["attributes"]["POSITION"].get<size_t>()];
    EXPECT_EQ(accessor["min"], json({0.0, 0.0, -1.0}));
    EXPECT_EQ(accessor["max"], json({2.0, 3.0, 0.0}));
    const json& view = d["bufferViews"][accessor["bufferView"].get<size_t>()];
    std::array<float, 9> positions{};
    ASSERT_EQ(view["byteLength"], sizeof positions);
    std::memcpy(positions.data(), glb.bin.data() + view["byteOffset"].get<size_t>(),
                sizeof positions);
    EXPECT_THAT(positions, testing::ElementsAre(0, 0, 0, 2, 0, 0, 0, 3, -1));
    for (const json& any : d["bufferViews"]) {
        EXPECT_EQ(any["byteOffset"].get<size_t>() % 4, 0U);
    }
}

TEST(GlbWriter, Images_DecodeToTheSamePixels) {
    const scene::Scene scene = everything();
    const Glb glb = written(scene, "images.glb");
    for (size_t i = 0; i < scene.images.size(); ++i) {
        const size_t view_index = glb.document["images"][i]["bufferView"];
        const json& view = glb.document["bufferViews"][view_index];
        png_image png{};
        png.version = PNG_IMAGE_VERSION;
        ASSERT_NE(png_image_begin_read_from_memory(
                      &png, glb.bin.data() + view["byteOffset"].get<size_t>(), view["byteLength"]),
                  0);
        EXPECT_EQ((png.format & PNG_FORMAT_FLAG_ALPHA) != 0, i == 1) << "alpha only where used";
        png.format = PNG_FORMAT_RGBA;
        std::vector<std::byte> pixels(PNG_IMAGE_SIZE(png));
        ASSERT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
        EXPECT_EQ(pixels, scene.images[i].rgba8);
    }
}

TEST(GlbWriter, ManyVertices_IndicesAreWide) {
    scene::Scene scene = everything();
    scene::Primitive& primitive = scene.meshes[0].primitives[1];
    primitive.positions.resize(70'000, {1, 1, 1});
    primitive.normals.resize(70'000, {0, 1, 0});
    primitive.uv0.resize(70'000);
    primitive.indices = {0, 1, 69'999};
    const Glb glb = written(scene, "wide.glb");
    const auto typeOf = [&](size_t index) {
        const json& p = glb.document["meshes"][0]["primitives"][index];
        return glb.document["accessors"][p["indices"].get<size_t>()]["componentType"].get<int>();
    };
    EXPECT_EQ(typeOf(0), 5123);
    EXPECT_EQ(typeOf(1), 5125);
}

TEST(GlbWriter, EmptyScene_ReadsAsAFileWithoutABuffer) {
    const Glb glb = written({}, "empty.glb");
    EXPECT_TRUE(glb.bin.empty());
    for (const char* key : {"buffers", "meshes", "nodes", "extensionsUsed"}) {
        EXPECT_FALSE(glb.document.contains(key)) << key;
    }
}

TEST(GlbWriter, Hall_ReadsBackWhole) {
    const scene::Scene hall = builtin_scene::makeHall();
    const Glb glb = written(hall, "hall.glb");
    EXPECT_EQ(glb.document["meshes"].size(), hall.meshes.size());
    EXPECT_EQ(glb.document["images"].size(), hall.images.size());
    EXPECT_EQ(glb.document["nodes"].size(),
              hall.instances.size() + hall.cameras.size() + hall.lights.size());
}

TEST(GlbWriter, WrittenTwice_SameBytes) {
    const scene::Scene scene = everything();
    written(scene, "first.glb");
    written(scene, "second.glb");
    EXPECT_EQ(bytesOf(fileNamed("first.glb")), bytesOf(fileNamed("second.glb")));
}

TEST(GlbWriter, ShearedInstance_IsRefusedByName) {
    scene::Scene scene = everything();
    scene.instances[1].world_from_object[1].x = 0.5;
    const auto result = writeGlb(scene, fileNamed("sheared.glb"));
    ASSERT_TRUE(result.has_error());
    EXPECT_EQ(result.error().code, ErrorCode::kScene);
    EXPECT_THAT(result.error().message, HasSubstr("'mirror'"));
    EXPECT_THAT(result.error().message, HasSubstr("sheared"));
}

TEST(GlbWriter, ImageOfTheWrongSize_IsRefusedByName) {
    scene::Scene scene = everything();
    scene.images[1].rgba8.own().pop_back();
    const auto result = writeGlb(scene, fileNamed("wrong_size.glb"));
    ASSERT_TRUE(result.has_error());
    EXPECT_THAT(result.error().message, HasSubstr("'veiled' has 15 bytes"));
}

TEST(GlbWriter, NameThatIsNotUtf8_IsRefused) {
    scene::Scene scene = everything();
    scene.meshes[0].name = "\xff";
    const auto result = writeGlb(scene, fileNamed("name.glb"));
    ASSERT_TRUE(result.has_error());
    EXPECT_THAT(result.error().message, HasSubstr("UTF-8"));
}

TEST(GlbWriter, FolderThatIsMissing_IsAnIoErrorWithTheReason) {
    const auto result = writeGlb({}, fileNamed("missing") / "folder" / "a.glb");
    ASSERT_TRUE(result.has_error());
    EXPECT_EQ(result.error().code, ErrorCode::kIo);
    EXPECT_THAT(result.error().message, HasSubstr("No such file or directory"));
}

TEST(GlbWriter, FullDevice_IsAnIoError) {
    if (!std::filesystem::exists("/dev/full")) {
        GTEST_SKIP() << "no /dev/full here";
    }
    // A link, so that the clean-up has something of its own to remove.
    const auto link = fileNamed("full.glb");
    std::filesystem::remove(link);
    std::filesystem::create_symlink("/dev/full", link);
    const auto result = writeGlb(everything(), link);
    ASSERT_TRUE(result.has_error());
    EXPECT_EQ(result.error().code, ErrorCode::kIo);
    EXPECT_FALSE(std::filesystem::is_symlink(link));
    EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

} // namespace
} // namespace froxel::gltf_writer
