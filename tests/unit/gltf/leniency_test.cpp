// Files that are not as glTF has it, but that others open: the scene, and a warning that says so.
#include "unit/gltf/image_files.h"
#include "unit/gltf/scene_file.h"
#include "unit/png/png_file.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <limits>

namespace froxel::gltf {
namespace {

using froxel::test::plainPng;
using scene::Severity;
using test::Bytes;
using test::bytesOf;
using test::failure;
using test::Json;
using test::loaded;
using test::SceneFile;
using test::TempFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The scene, which has this one warning.
scene::Scene takenWith(const Result<scene::Scene>& result,
                       Severity severity,
                       const char* place,
                       const char* words) {
    scene::Scene scene = loaded(result);
    EXPECT_THAT(test::warningLines(scene), ElementsAre(AllOf(HasSubstr(place), HasSubstr(words))));
    EXPECT_EQ(scene.warnings.empty() ? severity : scene.warnings[0].severity, severity);
    return scene;
}

std::vector<glm::dvec3> placesOf(const scene::Scene& scene) {
    std::vector<glm::dvec3> places;
    for (const scene::Instance& instance : scene.instances) {
        places.emplace_back(instance.world_from_object[3]);
    }
    return places;
}

SceneFile withNodes(const char* nodes, const Json& listed) {
    SceneFile file;
    file.json["nodes"] = Json::parse(nodes);
    file.json["scenes"][0]["nodes"] = listed;
    return file;
}

TEST(Leniency, ListedChild_StartsWithoutTheNodesAbove) {
    const SceneFile file = withNodes(R"([{"children": [1], "translation": [5, 0, 0]},
                                         {"mesh": 0, "translation": [0, 1, 0]}])",
                                     {1});
    EXPECT_THAT(placesOf(takenWith(
                    file.load(), Severity::kInformation, "SCENE_NON_ROOT_NODE at /scenes/0/nodes",
                    "scene 0 lists node 1, a child of node 0; it is placed without")),
                ElementsAre(glm::dvec3(0, 1, 0)));
}

TEST(Leniency, EveryNodeListed_EachIsThereOnceUnderItsParent) {
    const SceneFile file = withNodes(R"([{"children": [1], "translation": [5, 0, 0]},
                                         {"mesh": 0, "translation": [0, 1, 0], "children": [2]},
                                         {"mesh": 0, "translation": [0, 1, 0]}])",
                                     {2, 0, 1});
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(placesOf(scene), ElementsAre(glm::dvec3(5, 1, 0), glm::dvec3(5, 2, 0)));
    EXPECT_EQ(scene.warnings.size(), 2U);
}

TEST(Leniency, NodeListedTwice_IsThereOnce) {
    const SceneFile file = withNodes(R"([{"mesh": 0}])", {0, 0});
    EXPECT_EQ(takenWith(file.load(), Severity::kInformation,
                        "DUPLICATE_ELEMENTS at /scenes/0/nodes", "lists node 0 twice")
                  .instances.size(),
              1U);
}

TEST(Leniency, ChildListedTwice_IsThereOnce) {
    const SceneFile file = withNodes(R"([{"children": [1, 1]}, {"mesh": 0}])", {0});
    EXPECT_EQ(takenWith(file.load(), Severity::kInformation,
                        "DUPLICATE_ELEMENTS at /nodes/0/children", "node 0 lists node 1 twice")
                  .instances.size(),
              1U);
}

TEST(Leniency, TwoParents_TheFirstCounts) {
    const SceneFile file = withNodes(R"([{"children": [2], "translation": [5, 0, 0]},
                                         {"children": [2], "translation": [6, 0, 0]},
                                         {"mesh": 0}])",
                                     {1, 0});
    EXPECT_THAT(placesOf(takenWith(file.load(), Severity::kWarning,
                                   "NODE_PARENT_OVERRIDE at /nodes/1/children",
                                   "node 2 is a child of node 0 and of node 1")),
                ElementsAre(glm::dvec3(5, 0, 0)));
}

TEST(Leniency, NoScene_AllTreesAreShown) {
    SceneFile file;
    file.json.erase("scene");
    file.json.erase("scenes");
    EXPECT_EQ(takenWith(file.load(), Severity::kInformation, "NO_SCENE at :", "no scene")
                  .instances.size(),
              1U);
}

TEST(Leniency, EmptyScene_IsEmpty) {
    SceneFile file;
    file.json["scenes"][0] = Json::object();
    EXPECT_THAT(takenWith(file.load(), Severity::kWarning, "NOTHING_DRAWN at :", "nothing is drawn")
                    .instances,
                IsEmpty());
}

TEST(Leniency, RotationNotUnit_IsMadeUnit) {
    SceneFile file;
    file.json["nodes"][0]["rotation"] = {0, 0, 3, 0}; // half a turn about z
    const scene::Scene scene =
        takenWith(file.load(), Severity::kInformation,
                  "NODE_ROTATION_NON_UNIT at /nodes/0/rotation", "length 3, which is made 1");
    EXPECT_EQ(glm::dvec3(scene.instances.at(0).world_from_object[0]), glm::dvec3(-1, 0, 0));
}

TEST(Leniency, RotationOfBytes_IsNear1AndNotTold) {
    SceneFile file;
    file.json["nodes"][0]["rotation"] = {0.70866, 0, 0, 0.70866}; // 90 / 127: length 1.0022
    EXPECT_THAT(loaded(file.load()).warnings, IsEmpty());
}

TEST(Leniency, RotationOfZero_IsNone) {
    SceneFile file;
    file.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
    const scene::Scene scene = takenWith(file.load(), Severity::kWarning, "/nodes/0/rotation",
                                         "rotation of length 0 and is not rotated");
    EXPECT_EQ(scene.instances.at(0).world_from_object, glm::dmat4(1));
}

TEST(Leniency, InstanceRotationOfZero_IsNone) {
    SceneFile file;
    file.useExtension("EXT_mesh_gpu_instancing");
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
        file.addAccessor<float>({0, 0, 0, 0}, 4);
    const scene::Scene scene =
        takenWith(file.load(), Severity::kWarning,
                  "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION", "length 0");
    EXPECT_EQ(scene.instances.at(0).world_from_object, glm::dmat4(1));
}

TEST(Leniency, ShearingMatrix_IsTaken) {
    SceneFile file;
    file.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const scene::Scene scene = takenWith(file.load(), Severity::kInformation,
                                         "NODE_MATRIX_NON_TRS at /nodes/0/matrix", "shears");
    EXPECT_EQ(glm::dvec3(scene.instances.at(0).world_from_object[1]), glm::dvec3(0.5, 1, 0));
}

TEST(Leniency, MatrixWithARoundedLastRow_IsAffine) {
    SceneFile file;
    file.json["nodes"][0]["matrix"] = {1, 0, 0, 1e-9, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.9999999};
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.instances.at(0).world_from_object, glm::dmat4(1));
    EXPECT_THAT(scene.warnings, IsEmpty());
}

// Two triangles; the corners of the second are the fourth to sixth vertices.
SceneFile twoTriangles(const std::vector<float>& second) {
    SceneFile file;
    std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    positions.insert(positions.end(), second.begin(), second.end());
    file.attributes()["POSITION"] = file.addAccessor<float>(positions, 3);
    return file;
}

TEST(Leniency, PositionNotFinite_DropsItsTriangles) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        SceneFile file = twoTriangles({0, 0, 7, 1, bad, 7, 0, 1, 7});
        file.attributes()["NORMAL"] =
            file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
        const scene::Scene scene =
            takenWith(file.load(), Severity::kWarning,
                      "ACCESSOR_INVALID_FLOAT at /meshes/0/primitives/0/attributes/POSITION",
                      "1 elements of POSITION that are not finite");
        const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
        EXPECT_THAT(primitive.indices, ElementsAre(0, 1, 2));
        EXPECT_EQ(primitive.bounds.max, glm::vec3(1, 1, 7)) << "of what is finite";
    }
}

TEST(Leniency, PositionsAllNotFinite_NothingIsDrawn) {
    SceneFile file;
    file.attributes()["POSITION"] = file.addAccessor<float>(std::vector<float>(9, kNan), 3);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(scene.instances, IsEmpty());
    EXPECT_EQ(scene.warnings.size(), 2U);
}

TEST(Leniency, NormalNotFinite_IsThatOfItsTriangles) {
    for (const float bad : {kNan, kInfinity, 0.0F}) {
        SceneFile file;
        file.attributes()["NORMAL"] = file.addAccessor<float>({1, 0, 0, bad, 0, 0, 0, 1, 0}, 3);
        const scene::Scene scene =
            takenWith(file.load(), Severity::kWarning,
                      "ACCESSOR_NON_UNIT at /meshes/0/primitives/0/attributes/NORMAL",
                      "1 normals of length 0 or not finite");
        EXPECT_THAT(scene.meshes.at(0).primitives.at(0).normals,
                    ElementsAre(glm::vec3(1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0)));
    }
}

TEST(Leniency, NormalOfNoTriangle_IsUp) {
    SceneFile file = twoTriangles({0, 0, 7, 1, 0, 7, 0, 1, 7});
    file.attributes()["NORMAL"] = file.addAccessor<float>(std::vector<float>(18, 0), 3);
    file.primitive()["indices"] = file.addAccessor<uint8_t>({0, 1, 2}, 1);
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).normals.at(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).normals.at(5), glm::vec3(0, 1, 0));
}

TEST(Leniency, TangentNotFinite_AllAreDerived) {
    for (const size_t component : {0U, 3U}) {
        SceneFile file;
        file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
        std::vector<float> tangents{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
        tangents[4 + component] = kNan;
        file.attributes()["TANGENT"] = file.addAccessor<float>(tangents, 4);
        EXPECT_THAT(takenWith(file.load(), Severity::kWarning, "/attributes/TANGENT", "derived")
                        .meshes.at(0)
                        .primitives.at(0)
                        .tangents,
                    IsEmpty());
    }
}

TEST(Leniency, TexcoordAndColorNotFinite_AreZeroAndWhite) {
    SceneFile file;
    file.attributes()["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    file.attributes()["TEXCOORD_0"] = file.addAccessor<float>({0.5F, 1, kNan, 1, 1, 1}, 2);
    file.attributes()["COLOR_0"] = file.addAccessor<float>({0.5F, 0, 0, kNan, 0, 0, 0.5F, 0, 0}, 3);
    const scene::Scene scene = loaded(file.load());
    EXPECT_THAT(test::warningLines(scene),
                ElementsAre(HasSubstr("COLOR_0"), HasSubstr("TEXCOORD_0")));
    const scene::Primitive& primitive = scene.meshes.at(0).primitives.at(0);
    EXPECT_EQ(primitive.uv0.at(1), glm::vec2(0));
    EXPECT_EQ(primitive.uv0.at(0), glm::vec2(0.5, 1));
    EXPECT_EQ(primitive.colors.at(1), glm::vec4(1));
    EXPECT_EQ(primitive.colors.at(0), glm::vec4(0.5, 0, 0, 1));
}

// What the file says of its bounds is never used.
TEST(Leniency, MinAndMaxMissingOrWrong_AreComputed) {
    SceneFile file;
    EXPECT_FALSE(file.json["accessors"][0].contains("min"));
    EXPECT_EQ(loaded(file.load()).bounds_world.max, glm::dvec3(1, 1, 0));
    file.json["accessors"][0].update({{"min", {7, 7, 7}}, {"max", {8, 8, 8}}});
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.bounds_world.max, glm::dvec3(1, 1, 0));
    EXPECT_EQ(scene.bounds_world.min, glm::dvec3(0, 0, 0));
}

TEST(Leniency, UnalignedStride_IsRead) {
    SceneFile file;
    Bytes bytes;
    for (const float x : {1.0F, 2.0F, 4.0F}) {
        const Bytes corner = bytesOf<float>({x, x * x, 0});
        bytes.insert(bytes.end(), corner.begin(), corner.end());
        bytes.push_back(std::byte{0xEE});
    }
    file.attributes()["POSITION"] = file.addAccessorOf(file.addView(bytes, 13), 5126, 3, 3);
    const scene::Scene scene = takenWith(file.load(), Severity::kInformation,
                                         "/bufferViews/1/byteStride", "has byteStride 13");
    EXPECT_THAT(scene.meshes.at(0).primitives.at(0).positions,
                ElementsAre(glm::vec3(1, 1, 0), glm::vec3(2, 4, 0), glm::vec3(4, 16, 0)));
}

TEST(Leniency, UnalignedOffset_IsRead) {
    SceneFile file;
    Bytes bytes{std::byte{0xEE}, std::byte{0xEE}, std::byte{0xEE}};
    const Bytes corners = bytesOf<float>({1, 1, 0, 2, 4, 0, 4, 16, 0});
    bytes.insert(bytes.end(), corners.begin(), corners.end());
    const int accessor = file.addAccessorOf(file.addView(bytes), 5126, 3, 3);
    file.json["accessors"][1]["byteOffset"] = 3;
    file.attributes()["POSITION"] = accessor;
    const scene::Scene scene = takenWith(
        file.load(), Severity::kInformation, "ACCESSOR_TOTAL_OFFSET_ALIGNMENT at /accessors/1",
        "accessor 1 begins at byte 39 of its buffer; expected a multiple of 4");
    EXPECT_EQ(scene.meshes.at(0).primitives.at(0).positions.at(2), glm::vec3(4, 16, 0));
}

// The triangle with coordinates in set 0 alone, and a material that wants both sets.
SceneFile halfTextured() {
    SceneFile file;
    file.attributes()["TEXCOORD_0"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
    file.json["images"] = {{{"bufferView", file.addView(plainPng(1, 2, 3))}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = Json::parse(
        R"([{"name": "wall", "emissiveTexture": {"index": 0},
             "occlusionTexture": {"index": 0, "texCoord": 1}}])");
    file.primitive()["material"] = 0;
    return file;
}

TEST(Leniency, TexcoordSetMissing_LeavesItsTexturesOut) {
    const scene::Scene scene =
        takenWith(halfTextured().load(), Severity::kWarning,
                  "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS at /meshes/0/primitives/0",
                  "no texture coordinates for 1 textures of its material");
    const scene::Material& used = scene.materials.at(scene.meshes.at(0).primitives.at(0).material);
    EXPECT_EQ(used.name, "wall");
    EXPECT_EQ(used.emissive_texture.texture, 0U);
    EXPECT_EQ(used.occlusion_texture.texture, scene::kNone);
}

TEST(Leniency, TexcoordSetMissing_OthersOfTheMaterialKeepTheirTextures) {
    SceneFile file = halfTextured();
    Json whole = file.primitive();
    whole["attributes"]["TEXCOORD_1"] = whole["attributes"]["TEXCOORD_0"];
    file.json["meshes"][0]["primitives"].push_back(whole);
    file.json["meshes"][0]["primitives"].push_back(file.primitive());
    const scene::Scene scene = loaded(file.load());
    const auto& primitives = scene.meshes.at(0).primitives;
    EXPECT_EQ(scene.materials.size(), 2U);
    EXPECT_EQ(primitives.at(0).material, primitives.at(2).material);
    EXPECT_EQ(scene.materials.at(primitives.at(1).material).occlusion_texture.texture, 0U);
}

TEST(Leniency, TextureWithoutSource_IsLeftOut) {
    SceneFile file = halfTextured();
    file.json["materials"][0].erase("occlusionTexture");
    file.json["textures"][0] = Json::object();
    EXPECT_EQ(takenWith(file.load(), Severity::kWarning, "TEXTURE_WITHOUT_IMAGE at /textures/0",
                        "texture 0 has no image")
                  .materials.at(0)
                  .emissive_texture.texture,
              scene::kNone);
}

TEST(Leniency, PointsAndLines_AreCounted) {
    SceneFile file;
    for (const int mode : {0, 1, 2, 3}) {
        Json primitive = file.primitive();
        primitive["mode"] = mode;
        file.json["meshes"][0]["primitives"].push_back(primitive);
    }
    EXPECT_EQ(takenWith(file.load(), Severity::kWarning, "MODE_NOT_DRAWN at /meshes/0/primitives/1",
                        "4 primitives are points or lines and not drawn")
                  .meshes.at(0)
                  .primitives.size(),
              1U);
}

Result<scene::Scene> loadBytes(const Bytes& bytes) {
    const TempFolder folder;
    return load(folder.write("scene.glb", bytes));
}

TEST(LeniencyGlb, WrongLength_IsTakenWhereTheChunksFit) {
    for (const uint32_t told : {0U, 12U, 100U, 0xFFFFFFFFU}) {
        Bytes file = SceneFile().glb();
        const Bytes word = bytesOf<uint32_t>({told});
        std::copy(word.begin(), word.end(), file.begin() + 8);
        EXPECT_EQ(takenWith(loadBytes(file), Severity::kInformation, "GLB_LENGTH_MISMATCH at :",
                            ("the GLB header says " + std::to_string(told)).c_str())
                      .instances.size(),
                  1U);
    }
}

TEST(LeniencyGlb, TrailingBytes_AreIgnored) {
    for (const size_t count : {1U, 8U, 1000U}) {
        Bytes file = SceneFile().glb();
        file.resize(file.size() + count, std::byte{0x55});
        takenWith(loadBytes(file), Severity::kInformation, "GLB_LENGTH_MISMATCH", "bytes");
    }
}

TEST(Leniency, ByteOrderMark_IsSkipped) {
    SceneFile file;
    file.json["buffers"][0]["byteLength"] = file.binary.size();
    const TempFolder folder;
    folder.write("scene.bin", file.binary);
    takenWith(load(folder.write("scene.gltf", "\xEF\xBB\xBF" + file.json.dump())),
              Severity::kInformation, "BYTE_ORDER_MARK at :", "byte order mark");
}

TEST(Leniency, RequiredExtensionOfLooks_IsNamed) {
    SceneFile file;
    file.useExtension("ACME_paint", true);
    file.json["materials"] = Json::parse(R"([{"extensions": {"ACME_paint": {}}},
                                             {"extensions": {"ACME_paint": {}}}])");
    file.primitive()["material"] = 0;
    takenWith(file.load(), Severity::kWarning, "UNSUPPORTED_EXTENSION at /materials/0",
              "'ACME_paint' is not supported: the member 2 things is ignored, the first at "
              "'/materials/0'");
}

TEST(Leniency, RequiredExtensionOfData_IsRefused) {
    for (const char* place :
         {"/accessors/0", "/bufferViews/0", "/buffers/0", "/meshes/0/primitives/0"}) {
        SceneFile file;
        file.useExtension("ACME_packing", true);
        file.json[Json::json_pointer(place)]["extensions"]["ACME_packing"] = Json::object();
        EXPECT_THAT(failure(file.load()),
                    AllOf(HasSubstr("requires the extension 'ACME_packing'"), HasSubstr(place)));
        file.json.erase("extensionsRequired");
        EXPECT_EQ(loaded(file.load()).warnings.size(), 1U) << "what it packs is there without it";
    }
}

TEST(Leniency, RequiredExtensionOfMetadata_IsARemark) {
    SceneFile file;
    file.useExtension("EXT_mesh_features", true);
    file.primitive()["extensions"]["EXT_mesh_features"] = Json::object();
    takenWith(file.load(), Severity::kInformation,
              "UNSUPPORTED_EXTENSION at /meshes/0/primitives/0", "EXT_mesh_features");
}

TEST(Leniency, ExtensionThatNobodyDeclared_IsNamed) {
    SceneFile file;
    file.json["nodes"][0]["extensions"]["ACME_glow"] = {{"extensions", {{"inner", 1}}}};
    takenWith(file.load(), Severity::kWarning, "UNSUPPORTED_EXTENSION at /nodes/0", "'ACME_glow'");
}

TEST(Visibility, HiddenNode_HidesWhatIsBelowButNoCamera) {
    SceneFile file = withNodes(
        R"([{"children": [1, 2], "extensions": {"KHR_node_visibility": {"visible": false}}},
            {"mesh": 0, "camera": 0, "extensions": {"KHR_node_visibility": {"visible": true},
                                                   "KHR_lights_punctual": {"light": 0}}},
            {"children": [3]}, {"mesh": 0},
            {"mesh": 0, "name": "seen", "extensions": {"KHR_node_visibility": {}}}])",
        {0, 4});
    file.useExtension("KHR_node_visibility", true);
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    file.json["cameras"] =
        Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
    const scene::Scene scene = loaded(file.load());
    ASSERT_EQ(scene.instances.size(), 1U);
    EXPECT_EQ(scene.instances[0].name, "seen");
    EXPECT_EQ(scene.cameras.size(), 1U);
    EXPECT_THAT(scene.lights, IsEmpty());
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(Warnings, OfOneKind_AreTenAtMostAndTheRestAreCounted) {
    SceneFile file;
    file.json["nodes"] = Json::array();
    for (int i = 0; i < 25; ++i) {
        file.json["nodes"].push_back({{"rotation", {0, 0, 0, 2}}});
    }
    file.json["nodes"].push_back({{"mesh", 0}, {"rotation", {0, 0, 0, 0}}});
    file.json["scenes"][0]["nodes"] = Json::array();
    for (int i = 0; i < 26; ++i) {
        file.json["scenes"][0]["nodes"].push_back(i);
    }
    file.useExtension("ACME_glow");
    const scene::Scene scene = loaded(file.load());
    const auto severity = [&](size_t i) { return scene.warnings.at(i).severity; };
    ASSERT_EQ(scene.warnings.size(), 12U);
    EXPECT_EQ(scene.warnings_left_out, 15U);
    EXPECT_EQ(severity(1), Severity::kWarning) << "the gravest first";
    EXPECT_EQ(severity(2), Severity::kInformation);
}

} // namespace
} // namespace froxel::gltf
