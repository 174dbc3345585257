// A file that uses everything, broken in every single place: always a scene or one error line.
// Meant for the sanitizers above all.
#include "gltf/material_extensions.h"
#include "support/scene_promises.h"
#include "unit/gltf/scene_file.h"

#include <gtest/gtest.h>

#include <random>

namespace froxel::gltf::test {
namespace {

// One pixel, RGB.
constexpr const char* kPng =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/"
    "pLvAAAAAElFTkSuQmCC";

void addGeometry(SceneFile& file) {
    Json& attributes = file.attributes();
    attributes["NORMAL"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    attributes["TANGENT"] = file.addAccessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}, 4);
    attributes["TEXCOORD_0"] = file.addAccessor<float>({0, 0, 1, 0, 0, 1}, 2);
    attributes["TEXCOORD_1"] = file.addAccessor<uint16_t>({0, 0, 65535, 0, 0, 65535}, 2, true);
    const int colors =
        file.addView(bytesOf<uint8_t>({255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0}), 4);
    attributes["COLOR_0"] = file.addAccessorOf(colors, componentType<uint8_t>(), 3, 3, true);
    file.primitive()["indices"] = file.addAccessor<uint16_t>({0, 1, 2}, 1);
    const int indices = file.addView(bytesOf<uint8_t>({1}));
    const int values = file.addView(bytesOf<float>({2, 0, 0}));
    file.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", componentType<uint8_t>()}}},
        {"values", {{"bufferView", values}}}};
    file.primitive()["targets"] = {{{"POSITION", 0}}};
    file.json["meshes"][0]["weights"] = {0.5};
}

void addMaterial(SceneFile& file) {
    file.add("images", {{"uri", kPng}, {"name", "pixel"}});
    file.add("samplers", {{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    file.add("materials", Json::parse(R"({
        "pbrMetallicRoughness": {
            "baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.5, "roughnessFactor": 0.5,
            "baseColorTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform":
                {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2], "texCoord": 0}}},
            "metallicRoughnessTexture": {"index": 0}},
        "normalTexture": {"index": 0, "scale": 2},
        "occlusionTexture": {"index": 0, "strength": 0.5},
        "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1],
        "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
        "extensions": {}})"));
    Json& extensions = file.json["materials"][0]["extensions"];
    extensions = everyExtension();
    extensions[kEmissiveStrength]["emissiveStrength"] = 4;
    file.primitive()["material"] = 0;
}

void addNodes(SceneFile& file) {
    const int places = file.addAccessor<float>({0, 0, 0, 1, 0, 0}, 3);
    const int turns = file.addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1}, 4);
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(
        R"([{"type": "spot", "color": [1, 0.5, 0.25], "intensity": 10, "range": 5,
             "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}])");
    file.json["cameras"] = Json::parse(
        R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 10}},
            {"type": "orthographic",
             "orthographic": {"xmag": 1, "ymag": 2, "znear": 0, "zfar": 10}}])");
    file.json["nodes"] = Json::parse(
        R"([{"mesh": 0, "name": "node", "children": [1]},
            {"camera": 0, "rotation": [0, 0, 0, 1], "translation": [0, 0, 3], "scale": [1, 2, 1]},
            {"camera": 1, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1],
             "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"mesh": 0}])");
    file.json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", places}, {"ROTATION", turns}};
    file.json["scenes"][0]["nodes"] = {0, 2, 3};
}

void addMotion(SceneFile& file) {
    file.attributes()["JOINTS_0"] = file.addAccessor<uint8_t>(std::vector<uint8_t>(12, 0), 4);
    file.attributes()["WEIGHTS_0"] =
        file.addAccessor<uint8_t>(std::vector<uint8_t>(12, 64), 4, true);
    const int matrix =
        file.addView(bytesOf<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
    file.json["skins"] = Json::parse(R"([{"joints": [1], "skeleton": 0, "name": "skin"}])");
    file.json["skins"][0]["inverseBindMatrices"] =
        file.add("accessors",
                 {{"bufferView", matrix}, {"componentType", 5126}, {"count", 1}, {"type", "MAT4"}});
    file.json["nodes"][0]["skin"] = 0;
    const int times = file.addAccessor<float>({0, 1}, 1);
    const int places = file.addAccessor<float>({0, 0, 0, 1, 0, 0}, 3);
    const int weights = file.addAccessor<float>({0, 0, 1, 1, 0, 0}, 1);
    file.json["animations"] = Json::parse(R"([{"name": "clip", "samplers": [
        {"interpolation": "STEP"}, {"interpolation": "CUBICSPLINE"}], "channels": [
        {"sampler": 0, "target": {"node": 1, "path": "translation"}},
        {"sampler": 1, "target": {"node": 0, "path": "weights"}}]}])");
    file.json["animations"][0]["samplers"][0].update({{"input", times}, {"output", places}});
    file.json["animations"][0]["samplers"][1].update({{"input", times}, {"output", weights}});
}

void addVariants(SceneFile& file) {
    constexpr const char* kExtension = "KHR_materials_variants";
    file.json["extensions"][kExtension] =
        Json::parse(R"({"variants": [{"name": "one"}, {"name": "two"}]})");
    file.primitive()["extensions"][kExtension] =
        Json::parse(R"({"mappings": [{"material": 0, "variants": [0, 1]}]})");
}

SceneFile richFile() {
    SceneFile file;
    addGeometry(file);
    addMaterial(file);
    addVariants(file);
    addNodes(file);
    addMotion(file);
    file.json["buffers"][0]["byteLength"] = file.binary.size();
    return file;
}

void expectSceneOrLine(const Result<scene::Scene>& result, const std::string& what) {
    ASSERT_EQ(froxel::test::faultOf(result, "scene.gl"), "") << what;
}

void collect(const Json& value,
             const Json::json_pointer& path,
             std::vector<Json::json_pointer>& paths) {
    if (!path.empty()) {
        paths.push_back(path);
    }
    if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            collect(member, path / key, paths);
        }
    } else if (value.is_array()) {
        for (size_t i = 0; i < value.size(); ++i) {
            collect(value[i], path / i, paths);
        }
    }
}

std::vector<Json::json_pointer> everyPath(const Json& value) {
    std::vector<Json::json_pointer> paths;
    collect(value, Json::json_pointer(), paths);
    return paths;
}

// Writes the JSON as it is, without the builder's help.
Result<scene::Scene> loadJson(const Json& json, const TempFolder& folder) {
    return load(folder.write("scene.gltf", json.dump()));
}

TEST(HostileFuzz, RichFile_Loads) {
    const scene::Scene scene = loaded(richFile().load());
    EXPECT_EQ(scene.instances.size(), 3U);
    EXPECT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.images.size(), 1U);
    expectSceneOrLine(scene, "unbroken");
}

TEST(HostileFuzz, EveryValueReplaced_SceneOrOneLine) {
    const std::vector<Json> values = Json::parse(
        R"([null, true, -1, 0, 1, 2147483647, 4294967296, 1e39, 1e300, "../x", [], {}, [1, 2, 3],
            {"a": 1}])");
    const SceneFile rich = richFile();
    const TempFolder folder;
    folder.write("scene.bin", rich.binary);
    for (const Json::json_pointer& path : everyPath(rich.json)) {
        for (const Json& value : values) {
            Json broken = rich.json;
            broken[path] = value;
            ASSERT_NO_FATAL_FAILURE(expectSceneOrLine(loadJson(broken, folder),
                                                      path.to_string() + " = " + value.dump()));
        }
    }
}

TEST(HostileFuzz, EveryMemberRemoved_SceneOrOneLine) {
    const SceneFile rich = richFile();
    const TempFolder folder;
    folder.write("scene.bin", rich.binary);
    for (const Json::json_pointer& path : everyPath(rich.json)) {
        Json broken = rich.json;
        Json& parent = broken[path.parent_pointer()];
        if (parent.is_array()) {
            parent.erase(static_cast<size_t>(std::stoul(path.back())));
        } else {
            parent.erase(path.back());
        }
        ASSERT_NO_FATAL_FAILURE(
            expectSceneOrLine(loadJson(broken, folder), "without " + path.to_string()));
    }
}

TEST(HostileFuzz, GlbWithRandomBytes_SceneOrOneLine) {
    const Bytes whole = richFile().glb();
    const TempFolder folder;
    std::mt19937 random(20);
    for (int round = 0; round < 1000; ++round) {
        Bytes broken = whole;
        for (int i = 0; i < 1 + round % 4; ++i) {
            broken[random() % broken.size()] = static_cast<std::byte>(random() & 0xFFU);
        }
        ASSERT_NO_FATAL_FAILURE(expectSceneOrLine(load(folder.write("scene.glb", broken)),
                                                  "round " + std::to_string(round)));
    }
}

} // namespace
} // namespace froxel::gltf::test
