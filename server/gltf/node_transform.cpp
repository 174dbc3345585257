#include "gltf/node_transform.h"

#include "core/text.h"
#include "gltf/failure.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

namespace froxel::gltf {
namespace {

void checkLength(const std::vector<double>& values,
                 size_t length,
                 const char* property,
                 const std::string& name) {
    if (!values.empty() && values.size() != length) {
        fail(name + " has a " + property + " of " + std::to_string(values.size()) +
             " numbers; right is " + std::to_string(length));
    }
}

} // namespace

glm::dmat4 composeTransform(const glm::dvec3& translation,
                            const glm::dquat& rotation,
                            const glm::dvec3& scale,
                            const std::string& name) {
    const double length = glm::length(rotation);
    if (!(length > 0) || !std::isfinite(length)) {
        fail(name + " has a rotation of length " + numberText(length) + "; right is 1");
    }
    glm::dmat4 matrix = glm::mat4_cast(rotation / length);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] *= scale[axis];
    }
    matrix[3] = glm::dvec4(translation, 1);
    return matrix;
}

glm::dmat4 nodeTransform(const tinygltf::Node& node, const std::string& name) {
    checkLength(node.matrix, 16, "matrix", name);
    checkLength(node.translation, 3, "translation", name);
    checkLength(node.rotation, 4, "rotation", name);
    checkLength(node.scale, 3, "scale", name);
    if (!node.matrix.empty()) {
        glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
        const glm::dvec4 last_row = glm::transpose(matrix)[3];
        if (last_row != glm::dvec4(0, 0, 0, 1)) {
            fail(name + " has a matrix with the last row (" + numberText(last_row.x) + ", " +
                 numberText(last_row.y) + ", " + numberText(last_row.z) + ", " +
                 numberText(last_row.w) + "); right is (0, 0, 0, 1)");
        }
        return matrix;
    }
    const auto& t = node.translation;
    const auto& r = node.rotation;
    const auto& s = node.scale;
    return composeTransform(t.empty() ? glm::dvec3(0) : glm::dvec3(t[0], t[1], t[2]),
                            r.empty() ? glm::dquat(1, 0, 0, 0) : glm::dquat(r[3], r[0], r[1], r[2]),
                            s.empty() ? glm::dvec3(1) : glm::dvec3(s[0], s[1], s[2]), name);
}

void checkFinite(const glm::dmat4& world_from_node, const std::string& name) {
    const double* values = glm::value_ptr(world_from_node);
    const double* bad =
        std::find_if(values, values + 16, [](double value) { return !std::isfinite(value); });
    if (bad != values + 16) {
        fail(name + " has a world matrix with " + numberText(*bad) +
             "; right are transforms whose product is finite");
    }
}

} // namespace froxel::gltf
