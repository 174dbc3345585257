// What OBJ, PLY, STL and 3MF files hold, before it becomes glTF.
#pragma once

#include "gltf/failure.h"
#include "gltf/warnings.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace froxel::formats {

// The triangles of a mesh that have one material.
struct Part {
    size_t material = 0; // of the model
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   // as many or none: flat
    std::vector<glm::vec2> texcoords; // as many or none; v = 0 at the top of the image, as in glTF
    std::vector<glm::vec4> colors;    // as many or none; linear
    std::vector<uint32_t> indices;    // three a triangle; empty: positions as they come
};

struct Mesh {
    std::string name;
    std::vector<Part> parts;
};

struct Placed {
    size_t mesh = 0;
    glm::mat4 transform{1.0F}; // affine
};

struct Image {
    std::string path; // relative to the file, with slashes; empty: none
    glm::vec2 offset{0.0F};
    glm::vec2 scale{1.0F};
    bool clamped = false;
};

struct Material {
    std::string name;
    glm::vec4 base_color{0.6F, 0.6F, 0.6F, 1.0F}; // linear
    glm::vec3 emissive{0.0F};                     // linear
    float metallic = 0.0F;
    float roughness = 0.6F;
    bool cut_out = false; // by the alpha of its image, at 0.5
    Image base_color_image{};
    Image emissive_image{};
    Image normal_image{};
    Image roughness_image{}; // green: roughness, blue: metalness
};

struct Model {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Placed> placed;
    double unit_m = 1.0;
    bool z_up = false; // else y, as in glTF
};

// Codes of what these formats have and glTF has not.
namespace warning {
inline constexpr gltf::WarningKind kAssumed{"UNIT_AND_AXIS_ASSUMED", scene::Severity::kInformation};
inline constexpr gltf::WarningKind kNotRead{"NOT_READ", scene::Severity::kWarning};
} // namespace warning

} // namespace froxel::formats
