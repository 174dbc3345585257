// What loading a scene file promises, whatever is in it: a scene that can be drawn, or one line.
#pragma once

#include "core/error.h"
#include "scene/scene.h"
#include "scene/scene_check.h"

#include <cmath>
#include <string>
#include <string_view>

namespace froxel::test {

inline std::string faultOf(const scene::Primitive& primitive, size_t material_count) {
    if (primitive.normals.size() != primitive.positions.size()) {
        return "normals do not match positions";
    }
    const size_t count = primitive.positions.size();
    for (const size_t optional : {primitive.tangents.size(), primitive.uv0.size(),
                                  primitive.uv1.size(), primitive.colors.size()}) {
        if (optional != 0 && optional != count) {
            return "attributes do not match positions";
        }
    }
    if (primitive.material >= material_count) {
        return "a primitive's material does not exist";
    }
    for (const uint32_t index : primitive.indices) {
        if (index >= primitive.positions.size()) {
            return "an index is beyond the vertices";
        }
    }
    return {};
}

inline std::string faultOf(const scene::Scene& scene) {
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            if (auto fault = faultOf(primitive, scene.materials.size()); !fault.empty()) {
                return fault;
            }
        }
    }
    for (const scene::Instance& instance : scene.instances) {
        if (instance.mesh >= scene.meshes.size()) {
            return "an instance's mesh does not exist";
        }
    }
    for (const scene::Texture& texture : scene.textures) {
        if (texture.image >= scene.images.size()) {
            return "a texture's image does not exist";
        }
    }
    for (const scene::Material& material : scene.materials) {
        const glm::vec3 sum = material.emissive + glm::vec3(material.base_color) +
                              material.normal_scale + material.alpha_cutoff;
        if (!std::isfinite(sum.x)) {
            return "a material is not finite";
        }
    }
    for (const scene::PunctualLight& light : scene.lights) {
        if (!std::isfinite(light.intensity) || !std::isfinite(light.range_m)) {
            return "a light is not finite";
        }
    }
    return scene::findFault(scene).value_or("");
}

// Empty where it is as promised; `file` begins every refusal.
inline std::string faultOf(const Result<scene::Scene>& result, std::string_view file) {
    if (result) {
        return faultOf(*result);
    }
    const std::string& line = result.error().message;
    const bool one_line = line.find('\n') == std::string::npos && line.size() < 1000;
    return result.error().code == ErrorCode::kScene && one_line && line.starts_with(file)
               ? ""
               : "not one line of a scene's error: " + line;
}

} // namespace froxel::test
