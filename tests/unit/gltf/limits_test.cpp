// Values that are well-formed, but that a float, a budget or a reader of other chunks cannot hold.
#include "unit/gltf/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>

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

TEST(Limits, NumberBeyondSinglePrecision_IsLeftOut) {
    EXPECT_THAT(test::told(withEmissiveStrength("1e39").load()),
                HasSubstr("emissiveStrength is 1e+39; expected a number that single precision"));
    SceneFile file;
    file.add("cameras", Json::parse(R"({"type": "orthographic", "orthographic":
        {"xmag": 1, "ymag": 1e300, "znear": 0, "zfar": 1}})"));
    EXPECT_THAT(test::told(file.load()), HasSubstr("/cameras/0/orthographic/ymag is 1e+300"));
}

TEST(Limits, TextureOffsetBeyondSinglePrecision_IsLeftOut) {
    SceneFile file;
    file.useExtension("KHR_texture_transform");
    file.add("textures", Json::object());
    file.add("materials", Json::parse(R"({"emissiveTexture": {"index": 0, "extensions":
        {"KHR_texture_transform": {"offset": [0, -1e39]}}}})"));
    file.primitive()["material"] = 0;
    EXPECT_THAT(test::told(file.load()),
                HasSubstr("KHR_texture_transform/offset is -1e+39 at '1'; expected an array of 2"));
}

TEST(Limits, LightColorAboveOne_IsKept) {
    SceneFile file;
    file.useExtension("KHR_lights_punctual");
    file.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::parse(R"([{"type": "point", "color": [1, 1, 1.5]}])");
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const scene::Scene scene = loaded(file.load());
    EXPECT_EQ(scene.lights.at(0).color, glm::vec3(1, 1, 1.5));
    EXPECT_THAT(scene.warnings.at(0).message, HasSubstr("light 0 has the colour component 1.5"));
}

TEST(Limits, MorphThatOverflows_IsRefused) {
    SceneFile file;
    const int offsets = file.addAccessor<float>({0, 0, 3e38F, 0, 0, 0, 0, 0, 0}, 3);
    file.primitive()["targets"] = Json::array({{{"POSITION", offsets}}});
    file.json["meshes"][0]["weights"] = {2};
    EXPECT_THAT(failure(file.load()),
                HasSubstr("morph target POSITION takes element 0 out of range with the weight 2"));
}

constexpr uint64_t kBeyond31Bits = (1ULL << 31U) + 64;

TEST(Limits, BufferBeyond31Bits_KeepsItsNumbers) {
    SceneFile file;
    file.json["buffers"][0]["byteLength"] = kBeyond31Bits + 36;
    file.json["bufferViews"][0]["byteOffset"] = kBeyond31Bits;
    EXPECT_THAT(failure(file.load()),
                HasSubstr("buffer 0 says 2147483748 bytes, but there are 36"));
    file.json["bufferViews"][0]["byteOffset"] = kBeyond31Bits + 1;
    EXPECT_THAT(failure(file.load()),
                HasSubstr("bufferView 0 ends at byte 2147483749, but buffer 0 has 2147483748"));
    file.useExtension("EXT_meshopt_compression");
    file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0}, {"byteOffset", kBeyond31Bits}, {"byteLength", 40}, {"byteStride", 12},
        {"count", 3},  {"mode", "ATTRIBUTES"}};
    EXPECT_THAT(failure(file.load()), HasSubstr("bufferView 0 ends at byte 2147483752"));
}

uint64_t availableMemory() {
    std::ifstream file("/proc/meminfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("MemAvailable:")) {
            return std::stoull(line.substr(13)) * 1024;
        }
    }
    return 0;
}

// A file with a hole, in which the triangle lies behind 2 GiB of zeros.
TEST(Limits, GlbOver2GiB_IsLoaded) {
    const TempFolder folder;
    constexpr uint64_t kWanted = 3 * kBeyond31Bits;
    if (availableMemory() < kWanted || std::filesystem::space(folder.path()).available < kWanted) {
        GTEST_SKIP() << "needs 6 GiB of memory and of disk";
    }
    SceneFile file;
    file.json["buffers"][0]["byteLength"] = kBeyond31Bits + 36;
    file.json["bufferViews"][0]["byteOffset"] = kBeyond31Bits;
    Bytes start = file.glb();
    const size_t length_word = start.size() - 36 - 8; // of the binary chunk
    const Bytes triangle(start.end() - 36, start.end());
    start.resize(start.size() - 36);
    const Bytes chunk_bytes = bytesOf(std::vector<uint32_t>{kBeyond31Bits + 36});
    std::copy(chunk_bytes.begin(), chunk_bytes.end(),
              start.begin() + static_cast<std::ptrdiff_t>(length_word));
    const Bytes file_bytes =
        bytesOf(std::vector<uint32_t>{static_cast<uint32_t>(start.size() + kBeyond31Bits + 36)});
    std::copy(file_bytes.begin(), file_bytes.end(), start.begin() + 8);
    const std::filesystem::path path = folder.write("scene.glb", start);
    {
        std::ofstream out(path, std::ios::binary | std::ios::in);
        out.seekp(static_cast<std::streamoff>(start.size() + kBeyond31Bits));
        out.write(reinterpret_cast<const char*>(triangle.data()), 36);
        ASSERT_TRUE(out.good());
    }
    const scene::Scene scene = loaded(load(path));
    EXPECT_EQ(scene.bounds_world.max, glm::dvec3(1, 1, 0));
    EXPECT_TRUE(scene.warnings.empty());
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
