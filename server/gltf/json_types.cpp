#include "gltf/json_types.h"

#include "core/text.h"
#include "gltf/limits.h"
#include "gltf/material_extensions.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace froxel::gltf {
namespace {

using Json = nlohmann::json;

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
    kWord = 2048U,  // string, one of a few: who reads it says which
};

struct Rule {
    unsigned kinds = 0; // one of these
    size_t length = 0;  // of kNumbers; 0: any
};

// A name means the same kind of thing wherever glTF and the supported extensions use it, or one of
// a few.
struct RuleTable {
    std::unordered_map<std::string_view, Rule> of_name{
        {"accessors", {kObjects}},
        {"alphaCutoff", {kNumber}},
        {"alphaMode", {kWord}},
        {"animations", {kObjects}},
        {"asset", {kObject}},
        {"attributes", {kIndexMap}},
        {"baseColorFactor", {kNumbers, 4}},
        {"baseColorTexture", {kObject}},
        {"buffer", {kIndex}},
        {"bufferView", {kIndex}},
        {"bufferViews", {kObjects}},
        {"buffers", {kObjects}},
        {"byteLength", {kBytes}},
        {"byteOffset", {kBytes}},
        {"byteStride", {kIndex}},
        {"camera", {kIndex}},
        {"cameras", {kObjects}},
        {"channels", {kObjects}},
        {"children", {kIndices}},
        {"color", {kNumbers, 3}},
        {"componentType", {kIndex}},
        {"count", {kIndex}},
        {"diffuseFactor", {kNumbers, 4}},
        {"diffuseTexture", {kObject}},
        {"doubleSided", {kBool}},
        {"emissiveFactor", {kNumbers, 3}},
        {"emissiveStrength", {kNumber}},
        {"emissiveTexture", {kObject}},
        {"extensions", {kObject}},
        {"extensionsRequired", {kTexts}},
        {"extensionsUsed", {kTexts}},
        {"filter", {kWord}},
        {"glossinessFactor", {kNumber}},
        {"images", {kObjects}},
        {"index", {kIndex}},
        {"indices", {kIndex | kObject}},
        {"innerConeAngle", {kNumber}},
        {"input", {kIndex}},
        {"intensity", {kNumber}},
        {"interpolation", {kWord}},
        {"inverseBindMatrices", {kIndex}},
        {"joints", {kIndices}},
        {"light", {kIndex}},
        {"lights", {kObjects}},
        {"magFilter", {kIndex}},
        {"mappings", {kObjects}},
        {"material", {kIndex}},
        {"materials", {kObjects}},
        {"matrix", {kNumbers, 16}},
        {"mesh", {kIndex}},
        {"meshes", {kObjects}},
        {"metallicFactor", {kNumber}},
        {"metallicRoughnessTexture", {kObject}},
        {"mimeType", {kText}},
        {"minFilter", {kIndex}},
        {"minVersion", {kText}},
        {"mode", {kIndex | kWord}},
        {"name", {kText}},
        {"node", {kIndex}},
        {"nodes", {kIndices | kObjects}},
        {"normalTexture", {kObject}},
        {"normalized", {kBool}},
        {"occlusionTexture", {kObject}},
        {"offset", {kNumbers, 2}},
        {"orthographic", {kObject}},
        {"outerConeAngle", {kNumber}},
        {"output", {kIndex}},
        {"path", {kWord}},
        {"pbrMetallicRoughness", {kObject}},
        {"perspective", {kObject}},
        {"primitives", {kObjects}},
        {"range", {kNumber}},
        {"rotation", {kNumber | kNumbers, 4}},
        {"roughnessFactor", {kNumber}},
        {"sampler", {kIndex}},
        {"samplers", {kObjects}},
        {"scale", {kNumber | kNumbers}},
        {"scene", {kIndex}},
        {"scenes", {kObjects}},
        {"skin", {kIndex}},
        {"skins", {kObjects}},
        {"source", {kIndex}},
        {"sparse", {kObject}},
        {"specularFactor", {kNumbers, 3}}, // of KHR_materials_pbrSpecularGlossiness
        {"specularGlossinessTexture", {kObject}},
        {"spot", {kObject}},
        {"strength", {kNumber}},
        {"target", {kIndex | kObject}},
        {"targets", {kObjects}},
        {"texCoord", {kIndex}},
        {"textures", {kObjects}},
        {"translation", {kNumbers, 3}},
        {"type", {kWord}},
        {"uri", {kText}},
        {"values", {kObject}},
        {"variants", {kIndices | kObjects}},
        {"version", {kText}},
        {"visible", {kBool}},
        {"weights", {kNumbers}},
        {"wrapS", {kIndex}},
        {"wrapT", {kIndex}},
        {"xmag", {kNumber}},
        {"yfov", {kNumber}},
        {"ymag", {kNumber}},
        {"zfar", {kNumber}},
        {"znear", {kNumber}},
    };

    RuleTable() {
        for (const MaterialExtension& row : materialExtensions()) {
            scene::Material material;
            for (const MaterialFactor& factor : row.factors) {
                const size_t length = factor.of(material).size();
                Rule& rule = of_name[factor.key];
                rule.kinds |= length == 1 ? kNumber : kNumbers;
                rule.length = length == 1 ? rule.length : length;
            }
            for (const MaterialTexture& texture : row.textures) {
                of_name[texture.key].kinds |= kObject;
            }
        }
    }
};

// The rule of a member `name` whose JSON pointer is `path`.
Rule ruleFor(std::string_view name, std::string_view path) {
    static const RuleTable table;
    const auto found = table.of_name.find(name);
    if (found == table.of_name.end()) {
        return {};
    }
    Rule rule = found->second;
    if (name == "scale") { // of a node, or of a texture's transform
        rule.length = path.starts_with("/nodes/") ? 3 : 2;
    }
    return rule;
}

// Without these there is no geometry, or another one.
constexpr std::string_view kGeometry[] = {
    "accessors", "attributes", "bufferViews", "buffers",    "children", "indices",
    "mesh",      "meshes",     "nodes",       "primitives", "scenes",   "targets",
};

bool bearsGeometry(std::string_view name, std::string_view path) {
    constexpr std::string_view kWhole[] = {"/accessors/",         "/asset",
                                           "/bufferViews/",       "/buffers/",
                                           "/extensionsRequired", "/extensionsUsed"};
    const auto below = [&](std::string_view start) { return path.starts_with(start); };
    return std::any_of(std::begin(kWhole), std::end(kWhole), below) ||
           (below("/meshes/") && path.find("/extensions/") != std::string_view::npos &&
            path.find("/KHR_materials_variants/") == std::string_view::npos) ||
           std::find(std::begin(kGeometry), std::end(kGeometry), name) != std::end(kGeometry);
}

bool isWhole(const Json& value, uint64_t largest) {
    return value.is_number_unsigned() && value.get<uint64_t>() <= largest;
}

bool isIndex(const Json& value) {
    return isWhole(value, std::numeric_limits<int32_t>::max());
}

bool isBytes(const Json& value) {
    return isWhole(value, std::numeric_limits<uint32_t>::max());
}

// Numbers end as floats, which must not become infinite.
bool fitsSingle(const Json& value) {
    return value.is_number() &&
           std::abs(value.get<double>()) <= double{std::numeric_limits<float>::max()};
}

template <class Predicate>
bool all(const Json& value, Predicate predicate) {
    return std::all_of(value.begin(), value.end(), predicate);
}

bool fits(const Json& value, const Rule& rule) {
    const auto wants = [&](unsigned kinds) { return (rule.kinds & kinds) != 0; };
    switch (value.type()) {
    case Json::value_t::array:
        return (wants(kNumbers) && all(value, fitsSingle) &&
                (rule.length == 0 || value.size() == rule.length)) ||
               (wants(kIndices) && all(value, isIndex)) ||
               (wants(kObjects) && all(value, [](const Json& v) { return v.is_object(); })) ||
               (wants(kTexts) && all(value, [](const Json& v) { return v.is_string(); }));
    case Json::value_t::object:
        return wants(kObject) || (wants(kIndexMap) && all(value, isIndex));
    case Json::value_t::string:
        return wants(kText | kWord);
    case Json::value_t::boolean:
        return wants(kBool);
    default:
        return (wants(kIndex) && isIndex(value)) || (wants(kBytes) && isBytes(value)) ||
               (wants(kNumber) && fitsSingle(value));
    }
}

std::string describe(const Rule& rule) {
    const std::string numbers = rule.length == 0 ? "an array of numbers that single precision holds"
                                                 : "an array of " + std::to_string(rule.length) +
                                                       " numbers that single precision holds";
    const std::pair<Kind, std::string> names[] = {
        {kIndex, "an integer from 0 to 2147483647"},
        {kNumber, "a number that single precision holds"},
        {kNumbers, numbers},
        {kIndices, "an array of integers from 0 to 2147483647"},
        {kIndexMap, "an object of integers from 0 to 2147483647"},
        {kObject, "an object"},
        {kObjects, "an array of objects"},
        {kText, "a string"},
        {kTexts, "an array of strings"},
        {kBool, "true or false"},
        {kBytes, "an integer from 0 to 4294967295"},
        {kWord, "a string"},
    };
    std::string text;
    for (const auto& [bit, name] : names) {
        if ((rule.kinds & bit) != 0) {
            text += (text.empty() ? "" : " or ") + name;
        }
    }
    return text;
}

// The value, or, of an array or object, the first member to blame.
std::string shown(const Json& value, const Rule& rule) {
    if (!value.is_structured()) {
        return printable(value.dump(), 40);
    }
    for (const auto& [key, member] : value.items()) {
        const bool good = (rule.kinds & (kIndices | kIndexMap)) != 0 ? isIndex(member)
                          : (rule.kinds & kNumbers) != 0             ? fitsSingle(member)
                          : (rule.kinds & kTexts) != 0               ? member.is_string()
                                                                     : member.is_object();
        if (!good && !member.is_structured()) {
            return printable(member.dump(), 40) + " at '" + printable(key, 40) + "'";
        }
    }
    return value.is_array() ? "an array of " + std::to_string(value.size()) : "an object";
}

// 1.0 is an integer in JSON, where 1.5 is none.
void makeWhole(Json& value) {
    constexpr double kLargest = 9007199254740992.0; // 2^53
    if (value.is_number_float()) {
        const auto number = value.get<double>();
        if (number >= 0 && number <= kLargest && number == std::floor(number)) {
            value = static_cast<uint64_t>(number);
        }
    } else if (value.is_structured()) {
        for (Json& member : value) {
            if (member.is_number_float()) {
                makeWhole(member);
            }
        }
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

class Types {
  public:
    explicit Types(Warnings& warnings) : warnings_(warnings) {}

    // `path_` is the JSON pointer of `value`.
    void mendIn(Json& value) {
        size_t position = 0;
        for (auto it = value.begin(); it != value.end(); ++position) {
            const size_t length = path_.size();
            path_ += '/';
            path_ += value.is_object() ? printable(it.key()) : std::to_string(position);
            const bool kept = !value.is_object() || mended(it.key(), *it);
            if (kept && it->is_structured()) {
                mendIn(*it);
            }
            path_.resize(length);
            it = kept ? std::next(it) : value.erase(it);
        }
    }

  private:
    // Whether the member is of use now.
    bool mended(const std::string& name, Json& value) {
        const Rule rule = ruleFor(name, path_);
        if (rule.kinds == 0) {
            return true;
        }
        if ((rule.kinds & (kIndex | kBytes | kIndices | kIndexMap)) != 0) {
            makeWhole(value);
        }
        if (!fits(value, rule) && !brought(name, value, rule)) {
            return false;
        }
        if (name == "name" && value.is_string()) {
            shorten(value.get_ref<std::string&>());
        }
        const bool narrowed =
            (rule.kinds & kBytes) != 0 && path_.find("/extensions/") != std::string::npos;
        if ((rule.kinds & (kNumber | kNumbers)) != 0 || narrowed) {
            makeReal(value);
        }
        return true;
    }

    // Parsed text is UTF-8: it is cut between two characters.
    void shorten(std::string& name) {
        if (name.size() <= kMaxNameBytes) {
            return;
        }
        const size_t told = name.size();
        size_t end = kMaxNameBytes;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) {
            --end;
        }
        name.resize(end);
        name.shrink_to_fit();
        warnings_.add(warning::kNameLength, path_,
                      path_ + " has " + std::to_string(told) + " bytes; the first " +
                          std::to_string(end) + " are kept");
    }

    // Whether it could be brought to the right type.
    bool brought(const std::string& name, Json& value, const Rule& rule) {
        const std::string wrong =
            path_ + " is " + shown(value, rule) + "; expected " + describe(rule);
        if (bearsGeometry(name, path_)) {
            fail(wrong);
        }
        if ((rule.kinds & kWord) != 0 && value.is_primitive()) {
            value = value.dump(); // no such word, as its reader will say
            return true;
        }
        if ((rule.kinds & kObjects) != 0 && value.is_array()) {
            warnings_.add(warning::kType, path_, wrong + "; that is taken for an empty one");
            for (Json& member : value) {
                if (!member.is_object()) {
                    member = Json::object();
                }
            }
            return true;
        }
        warnings_.add(warning::kType, path_, wrong + "; it is left out");
        return false;
    }

    Warnings& warnings_;
    std::string path_;
};

} // namespace

void mendTypes(Json& root, Warnings& warnings) {
    Types(warnings).mendIn(root);
}

} // namespace froxel::gltf
