// Small glTF files, put together in memory and written to a folder of their own.
#pragma once

#include "gltf/gltf_loader.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::gltf::test {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

// A new empty folder, removed with all its content at the end.
class TempFolder {
  public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, std::span<const std::byte> bytes) const;
    std::filesystem::path write(const std::string& name, std::string_view text) const;

  private:
    std::filesystem::path path_;
};

template <class T>
constexpr int componentType() {
    if constexpr (std::is_same_v<T, int8_t>) {
        return 5120;
    } else if constexpr (std::is_same_v<T, uint8_t>) {
        return 5121;
    } else if constexpr (std::is_same_v<T, int16_t>) {
        return 5122;
    } else if constexpr (std::is_same_v<T, uint16_t>) {
        return 5123;
    } else if constexpr (std::is_same_v<T, uint32_t>) {
        return 5125;
    } else {
        static_assert(std::is_same_v<T, float>);
        return 5126;
    }
}

template <class T>
Bytes bytesOf(const std::vector<T>& values) {
    Bytes bytes(values.size() * sizeof(T));
    if (!values.empty()) { // whose data() may be null
        std::memcpy(bytes.data(), values.data(), bytes.size());
    }
    return bytes;
}

// One triangle (0,0,0) (1,0,0) (0,1,0) in one mesh, one node and one scene; `json` and `binary` are
// for a test to change. Everything lies in buffer 0.
class SceneFile {
  public:
    SceneFile();

    Json json;
    Bytes binary;

    // Appends to the binary, aligned to 4; the number of the new bufferView.
    int addView(const Bytes& bytes, size_t stride = 0);

    // A tightly packed accessor of `components` per element; its number.
    template <class T>
    int addAccessor(const std::vector<T>& values, size_t components, bool normalized = false) {
        const int view = addView(bytesOf(values));
        return addAccessorOf(view, componentType<T>(), values.size() / components, components,
                             normalized);
    }
    int addAccessorOf(
        int view, int component_type, size_t count, size_t components, bool normalized = false);

    // Appends an element to a top-level array; its number.
    int add(const char* array, Json element);

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    Json& attributes() { return primitive()["attributes"]; }
    void useExtension(const char* name, bool required = false);

    [[nodiscard]] Bytes glb() const;

    // Writes scene.gltf with scene.bin, or scene.glb, and loads it.
    [[nodiscard]] Result<scene::Scene> load() const;
    [[nodiscard]] Result<scene::Scene> loadGlb() const;
    [[nodiscard]] Result<scene::Scene> loadIn(const TempFolder& folder) const;
};

// Every row of the table of material extensions that has factors or textures, with all of its keys:
// numbers that no two share, textures of index 0 from both sets of coordinates in turn.
[[nodiscard]] Json everyExtension();

// The scene, or a test failure with the error's line and an empty scene.
[[nodiscard]] scene::Scene loaded(const Result<scene::Scene>& result);

// "CODE at /pointer: message" of every warning.
[[nodiscard]] std::vector<std::string> warningLines(const scene::Scene& scene);

// The lines of a file that is loaded, each with its end.
[[nodiscard]] std::string told(const Result<scene::Scene>& result);

// The line of an ErrorCode::kScene; a test failure where there is no error, more than one line or
// no file name in front.
[[nodiscard]] std::string failure(const Result<scene::Scene>& result);

// Writes `text` as scene.gltf and loads it.
[[nodiscard]] Result<scene::Scene> loadText(const std::string& text);

} // namespace froxel::gltf::test
