#include "unit/gltf/scene_file.h"

#include "gltf/material_extensions.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>

namespace froxel::gltf::test {
namespace {

constexpr std::array<const char*, 5> kTypes{"", "SCALAR", "VEC2", "VEC3", "VEC4"};

void appendWord(Bytes& bytes, uint32_t value) {
    const Bytes word = bytesOf(std::vector<uint32_t>{value});
    bytes.insert(bytes.end(), word.begin(), word.end());
}

void pad(Bytes& bytes, std::byte with) {
    bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

} // namespace

TempFolder::TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "froxel-gltf-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        ADD_FAILURE() << "no temporary folder at " << pattern;
    }
    path_ = pattern;
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TempFolder::write(const std::string& name,
                                        std::span<const std::byte> bytes) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
    EXPECT_TRUE(out.good()) << file;
    return file;
}

std::filesystem::path TempFolder::write(const std::string& name, std::string_view text) const {
    return write(name, std::as_bytes(std::span(text)));
}

SceneFile::SceneFile() {
    json = Json::parse(R"({
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "scene.bin"}],
        "meshes": [{"name": "triangle", "primitives": [{"attributes": {}}]}],
        "nodes": [{"name": "node", "mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0
    })");
    attributes()["POSITION"] = addAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
}

int SceneFile::addView(const Bytes& bytes, size_t stride) {
    pad(binary, std::byte{0});
    Json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) {
        view["byteStride"] = stride;
    }
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return add("bufferViews", std::move(view));
}

int SceneFile::addAccessorOf(
    int view, int component_type, size_t count, size_t components, bool normalized) {
    Json accessor{{"componentType", component_type},
                  {"count", count},
                  {"type", kTypes.at(components)},
                  {"normalized", normalized}};
    if (view >= 0) {
        accessor["bufferView"] = view;
    }
    return add("accessors", std::move(accessor));
}

int SceneFile::add(const char* array, Json element) {
    json[array].push_back(std::move(element));
    return static_cast<int>(json[array].size()) - 1;
}

void SceneFile::useExtension(const char* name, bool required) {
    json["extensionsUsed"].push_back(name);
    if (required) {
        json["extensionsRequired"].push_back(name);
    }
}

Bytes SceneFile::glb() const {
    Json root = json;
    root["buffers"][0].erase("uri");
    root["buffers"][0].emplace("byteLength", binary.size());
    const std::string text = root.dump();
    Bytes json_chunk(text.size());
    std::memcpy(json_chunk.data(), text.data(), text.size());
    pad(json_chunk, std::byte{' '});
    Bytes binary_chunk = binary;
    pad(binary_chunk, std::byte{0});
    Bytes file;
    appendWord(file, 0x46546C67);
    appendWord(file, 2);
    appendWord(file, static_cast<uint32_t>(12 + 8 + json_chunk.size() + 8 + binary_chunk.size()));
    appendWord(file, static_cast<uint32_t>(json_chunk.size()));
    appendWord(file, 0x4E4F534A);
    file.insert(file.end(), json_chunk.begin(), json_chunk.end());
    appendWord(file, static_cast<uint32_t>(binary_chunk.size()));
    appendWord(file, 0x004E4942);
    file.insert(file.end(), binary_chunk.begin(), binary_chunk.end());
    return file;
}

Result<scene::Scene> SceneFile::loadIn(const TempFolder& folder) const {
    Json root = json;
    if (root.contains("buffers")) {
        root["buffers"][0].emplace("byteLength", binary.size());
    }
    folder.write("scene.bin", binary);
    return gltf::load(folder.write("scene.gltf", root.dump()));
}

Result<scene::Scene> SceneFile::load() const {
    return loadIn(TempFolder());
}

Result<scene::Scene> SceneFile::loadGlb() const {
    const TempFolder folder;
    return gltf::load(folder.write("scene.glb", glb()));
}

Json everyExtension() {
    Json all = Json::object();
    double number = 0.125;
    int texcoord = 0;
    for (const MaterialExtension& row : materialExtensions()) {
        Json keys = Json::object();
        const auto next = [&](FactorRange range) {
            number += 0.0078125; // exact in fp32
            return range == FactorRange::kUnit ? number : 1 + number;
        };
        for (const MaterialFactor& factor : row.factors) {
            scene::Material material;
            const size_t count = factor.of(material).size();
            Json values = Json::array();
            for (size_t i = 0; i < count; ++i) {
                values.push_back(next(factor.range));
            }
            keys[factor.key] = count == 1 ? values[0] : values;
        }
        for (const MaterialTexture& texture : row.textures) {
            keys[texture.key] = {{"index", 0}, {"texCoord", texcoord}};
            texcoord = 1 - texcoord;
            if (texture.scale != nullptr) {
                keys[texture.key]["scale"] = next(FactorRange::kAny);
            }
        }
        if (!keys.empty()) {
            all[row.name] = keys;
        }
    }
    return all;
}

scene::Scene loaded(const Result<scene::Scene>& result) {
    if (!result.has_value()) {
        ADD_FAILURE() << result.error().message;
        return {};
    }
    return *result;
}

std::vector<std::string> warningLines(const scene::Scene& scene) {
    std::vector<std::string> lines;
    for (const scene::Warning& warning : scene.warnings) {
        lines.push_back(warning.code + " at " + warning.pointer + ": " + warning.message);
    }
    return lines;
}

std::string told(const Result<scene::Scene>& result) {
    std::string lines;
    for (const std::string& line : warningLines(loaded(result))) {
        lines += line + "\n";
    }
    return lines;
}

std::string failure(const Result<scene::Scene>& result) {
    if (result.has_value()) {
        ADD_FAILURE() << "the file is accepted";
        return "";
    }
    const Error& error = result.error();
    EXPECT_EQ(error.code, ErrorCode::kScene);
    EXPECT_TRUE(error.message.starts_with("scene.gl")) << error.message;
    EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
    return error.message;
}

Result<scene::Scene> loadText(const std::string& text) {
    const TempFolder folder;
    return gltf::load(folder.write("scene.gltf", text));
}

} // namespace froxel::gltf::test
