#include "gltf/instancing.h"

#include "gltf/extension_value.h"
#include "gltf/node_transform.h"

#include <tiny_gltf.h>

#include <optional>

namespace froxel::gltf {
namespace {

constexpr const char* kSemantics[] = {"TRANSLATION", "ROTATION", "SCALE"};

} // namespace

std::vector<glm::dmat4> nodeInstances(const tinygltf::Node& node,
                                      size_t index,
                                      AccessorReader& accessors,
                                      Budget& budget,
                                      Warnings& warnings) {
    const std::string name = thing("node", index);
    const tinygltf::Value* extension = findExtension(node.extensions, "EXT_mesh_gpu_instancing");
    if (extension == nullptr) {
        budget.take(1, name);
        return {glm::dmat4(1)};
    }
    const tinygltf::Value& attributes = extension->Get("attributes");
    std::optional<uint64_t> count;
    for (const char* semantic : kSemantics) {
        if (attributes.Has(semantic)) {
            const uint64_t own = accessors.count(intOr(attributes, semantic, -1), name);
            if (count && own != *count) {
                fail(name + " has instance attributes of " + std::to_string(*count) + " and " +
                     std::to_string(own) + " elements; expected equal counts");
            }
            count = own;
        }
    }
    if (!count) {
        fail(name + " has instances without TRANSLATION, ROTATION or SCALE; expected one of them");
    }
    budget.take(*count, name);
    std::vector<glm::vec3> translations(*count, glm::vec3(0));
    std::vector<glm::vec4> rotations(*count, glm::vec4(0, 0, 0, 1));
    std::vector<glm::vec3> scales(*count, glm::vec3(1));
    if (attributes.Has("TRANSLATION")) {
        translations = accessors.vectors<3>(intOr(attributes, "TRANSLATION", -1), name);
    }
    if (attributes.Has("ROTATION")) {
        rotations = accessors.vectors<4>(intOr(attributes, "ROTATION", -1), name);
    }
    if (attributes.Has("SCALE")) {
        scales = accessors.vectors<3>(intOr(attributes, "SCALE", -1), name);
    }
    const std::string pointer =
        pointerTo("nodes", index) + "/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION";
    std::vector<glm::dmat4> result;
    result.reserve(*count);
    for (size_t i = 0; i < *count; ++i) {
        const glm::dvec4 r(rotations[i]);
        const scene::Transform parts{glm::dvec3(translations[i]), glm::dquat(r.w, r.x, r.y, r.z),
                                     glm::dvec3(scales[i])};
        checkRotation(parts.rotation, pointer, name, warnings);
        result.push_back(scene::matrixOf(parts));
    }
    return result;
}

} // namespace froxel::gltf
