#include "gltf/variant_reader.h"

#include "gltf/extension_value.h"

namespace froxel::gltf {

namespace {

constexpr const char* kVariants = "KHR_materials_variants";

// Those of an array, of which json_types knows no single elements.
const tinygltf::Value::Array& elements(const tinygltf::Value& object, const char* key) {
    static const tinygltf::Value::Array kNone;
    return object.Has(key) && object.Get(key).IsArray()
               ? object.Get(key).Get<tinygltf::Value::Array>()
               : kNone;
}

} // namespace

std::map<uint32_t, int> variantMaterials(const tinygltf::Primitive& source,
                                         size_t variant_count,
                                         const std::string& pointer,
                                         const std::string& user,
                                         Warnings& warnings) {
    std::map<uint32_t, int> materials;
    const auto* extension = findExtension(source.extensions, kVariants);
    if (extension == nullptr) {
        return materials;
    }
    const auto leaveOut = [&](const WarningKind& kind, const std::string& what) {
        warnings.add(kind, pointer + "/extensions/" + kVariants, user + " " + what);
    };
    for (const tinygltf::Value& mapping : elements(*extension, "mappings")) {
        const int material = intOr(mapping, "material", -1);
        if (material < 0) {
            leaveOut(warning::kNoIndex, "has a mapping of variants without a material");
            continue;
        }
        for (const tinygltf::Value& value : elements(mapping, "variants")) {
            const int variant = value.IsNumber() ? value.GetNumberAsInt() : -1;
            if (variant < 0 || static_cast<size_t>(variant) >= variant_count) {
                leaveOut(warning::kUnresolved,
                         "uses variant " + std::to_string(variant) + "; the file has " +
                             std::to_string(variant_count) + ", counted from 0; it is left out");
            } else if (!materials.emplace(variant, material).second) {
                leaveOut(warning::kVariantTwice, "has two materials for variant " +
                                                     std::to_string(variant) +
                                                     "; the first counts");
            }
        }
    }
    return materials;
}

} // namespace froxel::gltf
