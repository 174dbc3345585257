#include "gltf/json_check.h"

#include "core/text.h"
#include "gltf/json_types.h"
#include "gltf/limits.h"
#include "gltf/material_extensions.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace froxel::gltf {
namespace {

using Json = nlohmann::json;

// Beside those of materials.
constexpr std::string_view kSupportedExtensions[] = {
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression", "EXT_texture_webp",
    "KHR_draco_mesh_compression", "KHR_lights_punctual",     "KHR_mesh_quantization",
    "KHR_materials_variants",     "KHR_meshopt_compression", "KHR_node_visibility",
    "KHR_texture_basisu",         "KHR_texture_transform",
};

// They say things about a scene that no picture of it shows.
constexpr std::string_view kMetadataExtensions[] = {
    "EXT_instance_features", "EXT_mesh_features", "EXT_structural_metadata", "KHR_xmp",
    "KHR_xmp_json_ld",
};

// They stand at primitives whose attributes can be read without them.
constexpr std::string_view kPrimitivesReadWithout[] = {
    "CESIUM_primitive_outline",
    "KHR_gaussian_splatting",
};

struct Required {
    std::string_view array;
    std::initializer_list<const char*> properties;
};
constexpr Required kRequired[] = {
    {"accessors", {"componentType", "count", "type"}},
    {"bufferViews", {"buffer", "byteLength"}},
    {"meshes", {"primitives"}},
};

// An extension that is not supported, and the objects that have it.
struct Foreign {
    std::string first; // JSON pointer
    size_t count = 0;
    std::string geometry; // the first whose bytes may mean something else with it; "": none
};
using Foreigners = std::map<std::string, Foreign>;

bool isOneOf(std::span<const std::string_view> names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool holdsGeometry(std::string_view path, std::string_view extension) {
    if (path.find("/primitives/") != std::string_view::npos) {
        return !isOneOf(kPrimitivesReadWithout, extension) &&
               !isOneOf(kMetadataExtensions, extension);
    }
    return path.starts_with("/accessors/") || path.starts_with("/bufferViews/") ||
           path.starts_with("/buffers/");
}

void dropUnknown(Json& object, const std::string& path, Foreigners& foreigners) {
    object.erase("extras");
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) {
        return;
    }
    for (auto it = extensions->begin(); it != extensions->end();) {
        if (isSupportedExtension(it.key())) {
            ++it;
            continue;
        }
        Foreign& foreign = foreigners[it.key()];
        if (foreign.count++ == 0) {
            foreign.first = printable(path, 200);
        }
        if (foreign.geometry.empty() && holdsGeometry(path, it.key())) {
            foreign.geometry = printable(path, 200);
        }
        it = extensions->erase(it);
    }
}

// `path` is the JSON pointer of `value`, which lies `depth` levels below the root.
void dropForeign(Json& value, std::string& path, int depth, Foreigners& foreigners) {
    if (depth > kMaxJsonDepth) {
        fail(printable(path, 200) + " is nested deeper than " + std::to_string(kMaxJsonDepth) +
             " levels");
    }
    if (value.is_object()) {
        dropUnknown(value, path, foreigners);
    }
    const size_t length = path.size();
    size_t position = 0;
    for (auto it = value.begin(); it != value.end(); ++it, ++position) {
        if (it->is_structured()) {
            path += '/';
            path += value.is_object() ? printable(it.key()) : std::to_string(position);
            dropForeign(*it, path, depth + 1, foreigners);
            path.resize(length);
        }
    }
}

void tellForeign(const std::string& name, const Foreign& foreign, Warnings& warnings) {
    const bool is_metadata = isOneOf(kMetadataExtensions, name);
    const std::string where = foreign.count == 0
                                  ? "is ignored"
                                  : "the member " + std::to_string(foreign.count) +
                                        (foreign.count == 1 ? " thing" : " things") +
                                        " is ignored, the first at '" + foreign.first + "'";
    warnings.add(is_metadata ? warning::kUnsupportedMetadata : warning::kUnsupportedExtension,
                 foreign.first,
                 "the extension '" + printable(name) + "' is not supported: " + where);
}

// Whatever the file uses and this loader does not have is named, declared or not.
void checkExtensions(const Json& root, Foreigners foreigners, Warnings& warnings) {
    const Json none = Json::array();
    const auto list = [&](const char* key) -> const Json& {
        return root.contains(key) ? root.at(key) : none;
    };
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        for (const Json& entry : list(key)) {
            const auto& name = entry.get_ref<const std::string&>();
            if (!isSupportedExtension(name)) {
                foreigners.try_emplace(name);
            }
        }
    }
    for (const Json& entry : list("extensionsRequired")) {
        const auto& name = entry.get_ref<const std::string&>();
        const auto found = foreigners.find(name);
        if (found != foreigners.end() && !found->second.geometry.empty()) {
            fail("the file requires the extension '" + printable(name) +
                 "', which is not supported, and '" + found->second.geometry +
                 "' cannot be read without it; expected a file without that extension");
        }
    }
    for (const auto& [name, foreign] : foreigners) {
        tellForeign(name, foreign, warnings);
    }
}

// glTF 1.0 has objects where 2.0 has arrays.
bool isMapped(const Json& root) {
    return root.contains("meshes") && root.at("meshes").is_object();
}

// Of version 1.0 even the arrays are objects, so this comes before all else.
void checkVersion(const Json& root) {
    const Json asset = root.value("asset", Json());
    const Json told = asset.is_object() ? asset.value("version", Json("")) : Json("");
    const std::string version = told.is_string() ? told.get<std::string>() : told.dump();
    if (version.starts_with("1") || (version.empty() && isMapped(root))) {
        failOldVersion("/asset/version is '" + printable(version, 40) + "'");
    }
    if (!version.starts_with("2.")) {
        fail("/asset/version is '" + printable(version, 40) + "'; 2.0 is supported");
    }
}

void checkMinimum(const Json& root) {
    const Json asset = root.value("asset", Json::object());
    const std::string minimum = asset.value("minVersion", "2.0");
    if (minimum != "2.0") {
        fail("/asset/minVersion is '" + printable(minimum) + "'; 2.0 is supported");
    }
}

void checkArrays(const Json& root) {
    for (const auto& [key, value] : root.items()) {
        const size_t most = key == "materials" ? kMaxMaterials : kMaxElements;
        if (value.is_array() && value.size() > most) {
            fail("/" + printable(key) + " has " + std::to_string(value.size()) +
                 " elements; at most " + std::to_string(most) + " are supported");
        }
    }
    for (const Required& rule : kRequired) {
        const auto array = root.find(rule.array);
        for (size_t i = 0; array != root.end() && i < array->size(); ++i) {
            for (const char* property : rule.properties) {
                if (!(*array)[i].contains(property)) {
                    fail("/" + std::string(rule.array) + "/" + std::to_string(i) + " has no '" +
                         property + "', which is required");
                }
            }
        }
    }
}

// Counts while nothing is kept. Its functions tell the parser to go on.
class ValueCounter final : public nlohmann::json_sax<Json> {
  public:
    explicit ValueCounter(ReadMemory& memory) : memory_(memory) {}

    [[nodiscard]] size_t count() const { return count_; }

    bool null() override { return add(1); }
    bool boolean(bool /*value*/) override { return add(1); }
    bool number_integer(int64_t /*value*/) override { return add(1); }
    bool number_unsigned(uint64_t /*value*/) override { return add(1); }
    bool number_float(double /*value*/, const std::string& /*text*/) override { return add(1); }
    bool string(std::string& /*value*/) override { return add(1); }
    bool binary(binary_t& /*value*/) override { return add(1); }
    bool start_object(size_t /*size*/) override { return add(2); }
    bool key(std::string& /*value*/) override { return add(1); }
    bool end_object() override { return true; }
    bool start_array(size_t /*size*/) override { return add(1); }
    bool end_array() override { return true; }
    bool parse_error(size_t /*position*/,
                     const std::string& /*last_token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        return false;
    }

  private:
    bool add(size_t count) {
        memory_.take(count * kJsonValueBytes, "the JSON text");
        count_ += count;
        return true;
    }

    ReadMemory& memory_;
    size_t count_ = 0;
};

} // namespace

bool isSupportedExtension(std::string_view name) {
    return isOneOf(kSupportedExtensions, name) ||
           std::ranges::any_of(materialExtensions(),
                               [&](const MaterialExtension& row) { return row.name == name; });
}

size_t countValues(std::span<const std::byte> text, ReadMemory& memory) {
    if (text.size() > kMaxJsonBytes) {
        fail("the JSON text has " + std::to_string(text.size()) + " bytes; at most " +
             std::to_string(kMaxJsonBytes) + " are supported");
    }
    memory.take(2 * text.size(), "the JSON text"); // its strings, and what tinygltf gets
    ValueCounter counter(memory);
    const auto* first = reinterpret_cast<const char*>(text.data());
    Json::sax_parse(first, first + text.size(), &counter); // parseJson() says what is wrong
    return counter.count();
}

Json parseJson(std::span<const std::byte> text) {
    const auto* first = reinterpret_cast<const char*>(text.data());
    try {
        Json root = Json::parse(first, first + text.size());
        if (!root.is_object()) {
            fail("the JSON text is not an object; expected a glTF 2.0 file");
        }
        return root;
    } catch (const Json::exception& error) {
        fail("it is not a glTF 2.0 file: " + printable(error.what(), 200));
    }
}

std::vector<scene::Extension> extensionsOf(const Json& root) {
    std::map<std::string, bool> read;
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        for (const Json& entry : root.value(key, Json::array())) {
            const auto& name = entry.get_ref<const std::string&>();
            if (name.size() <= kMaxNameBytes && read.size() < kMaxChoices) {
                read.emplace(name,
                             isSupportedExtension(name) || isOneOf(kMetadataExtensions, name));
            }
        }
    }
    std::vector<scene::Extension> extensions;
    for (const auto& [name, is] : read) {
        extensions.push_back({name, is});
    }
    return extensions;
}

void checkJson(Json& root, Warnings& warnings) {
    checkVersion(root);
    std::string path;
    Foreigners foreigners;
    dropForeign(root, path, 0, foreigners);
    mendTypes(root, warnings);
    checkMinimum(root);
    checkExtensions(root, std::move(foreigners), warnings);
    checkArrays(root);
}

} // namespace froxel::gltf
