// Values that are well-formed, but that a float, a budget or a reader of other chunks cannot hold.
#include "unit/gltf/scene_file.h"

#include <gmock/gmock.h>

namespace froxel::gltf::test {
namespace {

using ::testing::HasSubstr;

SceneFile withEmissiveStrength(const char* strength) {
    SceneFile file;
    file.useExtension("KHR_materials_emissive_strength");
    file.add("materials", {{"emissiveFactor", {1, 1, 1}}});
    file.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {
        {"emissiveStrength", Json::parse(strength)}};
    file.primitive()["material"] = 0;
    return file;
}

TEST(Limits, WholeNumberBeyond32Bits_KeepsItsValue) {
    const scene::Scene scene = loaded(withEmissiveStrength("6000000000").load());
    EXPECT_EQ(scene.materials.at(0).emissive.x, 6e9F);
}

TEST(Limits, NumberBeyondSinglePrecision_IsRefused) {
    EXPECT_THAT(failure(withEmissiveStrength("1e39").load()),
                HasSubstr("emissiveStrength is 1e+39; right is a number that single precision"));
    SceneFile file;
    file.add("cameras", Json::parse(R"({"type": "orthographic", "orthographic":
        {"xmag": 1, "ymag": 1e300, "znear": 0, "zfar": 1}})"));
    EXPECT_THAT(failure(file.load()), HasSubstr("/cameras/0/orthographic/ymag is 1e+300"));
}

TEST(Limits, TextureOffsetBeyondSinglePrecision_IsRefused) {
    SceneFile file;
    file.useExtension("KHR_texture_transform");
    file.add("textures", Json::object());
    file.add("materials", Json::parse(R"({"emissiveTexture": {"index": 0, "extensions":
        {"KHR_texture_transform": {"offset": [0, -1e39]}}}})"));
    file.primitive()["material"] = 0;
    EXPECT_THAT(failure(file.load()), HasSubstr("with the offset 0, -1e+39"));
}

TEST(Limits, LightColorAboveOne_IsRefused) {
    SceneFile file;
    file.useExtension("KHR_lights_punctual");
    file.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::parse(R"([{"type": "point", "color": [1, 1, 1.5]}])");
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    EXPECT_THAT(failure(file.load()), HasSubstr("light 0 has the color component 1.5"));
}

TEST(Limits, MorphThatOverflows_IsRefused) {
    SceneFile file;
    const int offsets = file.addAccessor<float>({0, 0, 3e38F, 0, 0, 0, 0, 0, 0}, 3);
    file.primitive()["targets"] = Json::array({{{"POSITION", offsets}}});
    file.json["meshes"][0]["weights"] = {2};
    EXPECT_THAT(failure(file.load()),
                HasSubstr("morph target POSITION takes element 0 out of range with the weight 2"));
}

// Targets may share one accessor: a few bytes of file must not ask for hours of work.
TEST(Limits, MorphTargetsInSum_AreBounded) {
    SceneFile file;
    constexpr size_t kVertices = 3'000'000;
    const int zeros = file.addAccessorOf(-1, componentType<float>(), kVertices, 3);
    file.attributes()["POSITION"] = zeros;
    file.primitive()["targets"] = Json::array();
    file.json["meshes"][0]["weights"] = Json::array();
    for (int i = 0; i < 1000; ++i) {
        file.primitive()["targets"].push_back({{"POSITION", zeros}});
        file.json["meshes"][0]["weights"].push_back(1);
    }
    EXPECT_THAT(failure(file.load()), HasSubstr("vertices of morph targets after"));
}

TEST(Limits, ForeignGlbChunk_IsIgnored) {
    SceneFile file;
    file.json["buffers"][0]["byteLength"] = file.binary.size();
    file.json["buffers"][0]["uri"] = "scene.bin";
    const std::string text = file.json.dump();
    const size_t padded = (text.size() + 3) / 4 * 4;
    const auto put = [](Bytes& to, uint32_t value) {
        const Bytes word = bytesOf(std::vector<uint32_t>{value});
        to.insert(to.end(), word.begin(), word.end());
    };
    Bytes glb;
    put(glb, 0x46546C67);
    put(glb, 2);
    put(glb, static_cast<uint32_t>(12 + 8 + padded + 8 + 4));
    put(glb, static_cast<uint32_t>(padded));
    put(glb, 0x4E4F534A);
    for (size_t i = 0; i < padded; ++i) {
        glb.push_back(i < text.size() ? static_cast<std::byte>(text[i]) : std::byte{' '});
    }
    put(glb, 4);
    put(glb, 0x21212121); // a type that nobody has defined
    put(glb, 0);
    const TempFolder folder;
    folder.write("scene.bin", file.binary);
    EXPECT_EQ(loaded(load(folder.write("scene.glb", glb))).instances.size(), 1U);
}

} // namespace
} // namespace froxel::gltf::test
