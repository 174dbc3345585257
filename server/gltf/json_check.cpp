#include "gltf/json_check.h"

#include "core/text.h"
#include "gltf/limits.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

namespace froxel::gltf {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kSupportedExtensions[] = {
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_basisu",
    "KHR_texture_transform",
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
    "KHR_materials_variants",
};

enum Kind : unsigned {
    kIndex = 1U,     // integer, 0..2^31-1
    kNumber = 2U,    // any
    kNumbers = 4U,   // array of numbers
    kIndices = 8U,   // array of kIndex
    kIndexMap = 16U, // object whose members are kIndex
    kObject = 32U,
    kObjects = 64U, // array of objects
    kText = 128U,
    kTexts = 256U, // array of strings
    kBool = 512U,
    kBytes = 1024U, // integer, 0..2^32-1: the binary chunk of a GLB file is no longer
};

// A name means the same kind of thing wherever glTF and the supported extensions use it, or one of
// a few.
struct KindTable {
    std::unordered_map<std::string_view, unsigned> of_name{
        {"accessors", kObjects},
        {"alphaCutoff", kNumber},
        {"alphaMode", kText},
        {"animations", kObjects},
        {"asset", kObject},
        {"attributes", kIndexMap},
        {"baseColorFactor", kNumbers},
        {"baseColorTexture", kObject},
        {"buffer", kIndex},
        {"bufferView", kIndex},
        {"bufferViews", kObjects},
        {"buffers", kObjects},
        {"byteLength", kBytes},
        {"byteOffset", kBytes},
        {"byteStride", kIndex},
        {"camera", kIndex},
        {"cameras", kObjects},
        {"channels", kObjects},
        {"children", kIndices},
        {"clearcoatFactor", kNumber},
        {"clearcoatNormalTexture", kObject},
        {"clearcoatRoughnessFactor", kNumber},
        {"clearcoatRoughnessTexture", kObject},
        {"clearcoatTexture", kObject},
        {"color", kNumbers},
        {"componentType", kIndex},
        {"count", kIndex},
        {"diffuseFactor", kNumbers},
        {"diffuseTexture", kObject},
        {"doubleSided", kBool},
        {"emissiveFactor", kNumbers},
        {"emissiveStrength", kNumber},
        {"emissiveTexture", kObject},
        {"extensions", kObject},
        {"extensionsRequired", kTexts},
        {"extensionsUsed", kTexts},
        {"filter", kText},
        {"glossinessFactor", kNumber},
        {"images", kObjects},
        {"index", kIndex},
        {"indices", kIndex | kObject},
        {"innerConeAngle", kNumber},
        {"input", kIndex},
        {"intensity", kNumber},
        {"interpolation", kText},
        {"inverseBindMatrices", kIndex},
        {"ior", kNumber},
        {"joints", kIndices},
        {"light", kIndex},
        {"lights", kObjects},
        {"magFilter", kIndex},
        {"material", kIndex},
        {"materials", kObjects},
        {"matrix", kNumbers},
        {"mesh", kIndex},
        {"meshes", kObjects},
        {"metallicFactor", kNumber},
        {"metallicRoughnessTexture", kObject},
        {"mimeType", kText},
        {"minFilter", kIndex},
        {"minVersion", kText},
        {"mode", kIndex | kText},
        {"name", kText},
        {"node", kIndex},
        {"nodes", kIndices | kObjects},
        {"normalTexture", kObject},
        {"normalized", kBool},
        {"occlusionTexture", kObject},
        {"offset", kNumbers},
        {"orthographic", kObject},
        {"outerConeAngle", kNumber},
        {"output", kIndex},
        {"path", kText},
        {"pbrMetallicRoughness", kObject},
        {"perspective", kObject},
        {"primitives", kObjects},
        {"range", kNumber},
        {"rotation", kNumber | kNumbers},
        {"roughnessFactor", kNumber},
        {"sampler", kIndex},
        {"samplers", kObjects},
        {"scale", kNumber | kNumbers},
        {"scene", kIndex},
        {"scenes", kObjects},
        {"skin", kIndex},
        {"skins", kObjects},
        {"source", kIndex},
        {"sparse", kObject},
        {"specularColorFactor", kNumbers},
        {"specularColorTexture", kObject},
        {"specularFactor", kNumber | kNumbers},
        {"specularGlossinessTexture", kObject},
        {"specularTexture", kObject},
        {"spot", kObject},
        {"strength", kNumber},
        {"target", kIndex | kObject},
        {"targets", kObjects},
        {"texCoord", kIndex},
        {"textures", kObjects},
        {"translation", kNumbers},
        {"type", kText},
        {"uri", kText},
        {"values", kObject},
        {"version", kText},
        {"visible", kBool},
        {"weights", kNumbers},
        {"wrapS", kIndex},
        {"wrapT", kIndex},
        {"xmag", kNumber},
        {"yfov", kNumber},
        {"ymag", kNumber},
        {"zfar", kNumber},
        {"znear", kNumber},
    };
};

const std::unordered_map<std::string_view, unsigned>& kinds() {
    static const KindTable table;
    return table.of_name;
}

struct Required {
    std::string_view array;
    std::initializer_list<const char*> properties;
};
constexpr Required kRequired[] = {
    {"accessors", {"componentType", "count", "type"}},
    {"bufferViews", {"buffer", "byteLength"}},
    {"buffers", {"byteLength"}},
    {"cameras", {"type"}},
    {"meshes", {"primitives"}},
};

bool isWhole(const Json& value, uint64_t largest) {
    return value.is_number_unsigned() && value.get<uint64_t>() <= largest;
}

bool isIndex(const Json& value) {
    return isWhole(value, std::numeric_limits<int32_t>::max());
}

bool isBytes(const Json& value) {
    return isWhole(value, std::numeric_limits<uint32_t>::max());
}

// Single numbers end as floats, which must not become infinite.
bool fitsSingle(const Json& value) {
    return value.is_number() &&
           std::abs(value.get<double>()) <= double{std::numeric_limits<float>::max()};
}

template <class Predicate>
bool all(const Json& value, Predicate predicate) {
    return std::all_of(value.begin(), value.end(), predicate);
}

bool fits(const Json& value, unsigned kind) {
    const auto wants = [kind](Kind bit) { return (kind & bit) != 0; };
    switch (value.type()) {
    case Json::value_t::array:
        return (wants(kNumbers) && all(value, [](const Json& v) { return v.is_number(); })) ||
               (wants(kIndices) && all(value, isIndex)) ||
               (wants(kObjects) && all(value, [](const Json& v) { return v.is_object(); })) ||
               (wants(kTexts) && all(value, [](const Json& v) { return v.is_string(); }));
    case Json::value_t::object:
        return wants(kObject) || (wants(kIndexMap) && all(value, isIndex));
    case Json::value_t::string:
        return wants(kText);
    case Json::value_t::boolean:
        return wants(kBool);
    default:
        return (wants(kIndex) && isIndex(value)) || (wants(kBytes) && isBytes(value)) ||
               (wants(kNumber) && fitsSingle(value));
    }
}

std::string describe(unsigned kind) {
    static constexpr std::pair<Kind, const char*> kNames[] = {
        {kIndex, "an integer from 0 to 2147483647"},
        {kNumber, "a number that single precision holds"},
        {kNumbers, "an array of numbers"},
        {kIndices, "an array of integers from 0 to 2147483647"},
        {kIndexMap, "an object of integers from 0 to 2147483647"},
        {kObject, "an object"},
        {kObjects, "an array of objects"},
        {kText, "a string"},
        {kTexts, "an array of strings"},
        {kBool, "true or false"},
        {kBytes, "an integer from 0 to 4294967295"},
    };
    std::string text;
    for (const auto& [bit, name] : kNames) {
        if ((kind & bit) != 0) {
            text += (text.empty() ? "" : " or ") + std::string(name);
        }
    }
    return text;
}

// The value, or, of an array or object, the first member to blame.
std::string shown(const Json& value, unsigned kind) {
    if (!value.is_structured()) {
        return printable(value.dump(), 40);
    }
    for (const auto& [key, member] : value.items()) {
        const bool good = (kind & (kIndices | kIndexMap)) != 0 ? isIndex(member)
                          : (kind & kNumbers) != 0             ? member.is_number()
                          : (kind & kTexts) != 0               ? member.is_string()
                                                               : member.is_object();
        if (!good && !member.is_structured()) {
            return printable(member.dump(), 40) + " at '" + printable(key, 40) + "'";
        }
    }
    return value.is_array() ? "an array" : "an object";
}

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

// tinygltf narrows an extension's whole numbers to 32 bits, but leaves reals as they are.
void makeReal(Json& value) {
    if (value.is_number_integer()) {
        value = value.get<double>();
    } else if (value.is_array()) {
        std::for_each(value.begin(), value.end(), makeReal);
    }
}

// `path` is the JSON pointer of `value`, which lies `depth` levels below the root.
void checkTypes(Json& value, std::string& path, int depth, Foreigners& foreigners) {
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
        path += '/';
        path += value.is_object() ? printable(it.key()) : std::to_string(position);
        if (value.is_object()) {
            const auto known = kinds().find(it.key());
            const unsigned kind = known == kinds().end() ? 0 : known->second;
            if (kind != 0 && !fits(*it, kind)) {
                fail(path + " is " + shown(*it, kind) + "; right is " + describe(kind));
            }
            const bool narrowed =
                (kind & kBytes) != 0 && path.find("/extensions/") != std::string::npos;
            if ((kind & (kNumber | kNumbers)) != 0 || narrowed) {
                makeReal(*it);
            }
        }
        if (it->is_structured()) {
            checkTypes(*it, path, depth + 1, foreigners);
        }
        path.resize(length);
    }
}

void tellForeign(const std::string& name, const Foreign& foreign, Warnings& warnings) {
    const bool is_metadata = isOneOf(kMetadataExtensions, name);
    const std::string where = foreign.count == 0
                                  ? "is ignored"
                                  : "what it says of " + std::to_string(foreign.count) +
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
                 "' cannot be read without it; right is a file without that extension");
        }
    }
    for (const auto& [name, foreign] : foreigners) {
        tellForeign(name, foreign, warnings);
    }
}

void checkVersion(const Json& root) {
    const Json asset = root.value("asset", Json::object());
    const std::string version = asset.value("version", "");
    if (!version.starts_with("2.")) {
        fail("/asset/version is '" + printable(version) + "'; 2.0 is supported");
    }
    const std::string minimum = asset.value("minVersion", "2.0");
    if (minimum != "2.0") {
        fail("/asset/minVersion is '" + printable(minimum) + "'; 2.0 is supported");
    }
}

void checkArrays(const Json& root) {
    for (const auto& [key, value] : root.items()) {
        if (value.is_array() && value.size() > kMaxElements) {
            fail("/" + printable(key) + " has " + std::to_string(value.size()) +
                 " elements; at most " + std::to_string(kMaxElements) + " are supported");
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

} // namespace

bool isSupportedExtension(std::string_view name) {
    return isOneOf(kSupportedExtensions, name);
}

Json parseJson(std::span<const std::byte> text) {
    if (text.size() > kMaxJsonBytes) {
        fail("the JSON text has " + std::to_string(text.size()) + " bytes; at most " +
             std::to_string(kMaxJsonBytes) + " are supported");
    }
    const auto* first = reinterpret_cast<const char*>(text.data());
    try {
        Json root = Json::parse(first, first + text.size());
        if (!root.is_object()) {
            fail("the JSON text is not an object; right is a glTF 2.0 file");
        }
        return root;
    } catch (const Json::exception& error) {
        fail("it is no glTF 2.0 file: " + printable(error.what(), 200));
    }
}

void checkJson(Json& root, Warnings& warnings) {
    std::string path;
    Foreigners foreigners;
    checkTypes(root, path, 0, foreigners);
    checkVersion(root);
    checkExtensions(root, std::move(foreigners), warnings);
    checkArrays(root);
}

} // namespace froxel::gltf
