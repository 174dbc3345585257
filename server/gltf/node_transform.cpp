#include "gltf/node_transform.h"

#include "core/text.h"
#include "gltf/failure.h"

#include <glm/gtc/type_ptr.hpp>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

namespace froxel::gltf {
namespace {

// What a rotation in bytes may be off; what is more was not made unit.
constexpr double kUnitTolerance = 0.01;
// Of the cosine between two axes, as matrices in single precision have it.
constexpr double kShearTolerance = 1e-3;
// Of the last row, which some exporters write as they computed it.
constexpr double kAffineTolerance = 1e-5;

// Axes that are not perpendicular, which no translation, rotation and scale gives.
bool shears(const glm::dmat3& matrix) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& one = matrix[i];
        const glm::dvec3& other = matrix[(i + 1) % 3];
        if (std::abs(glm::dot(one, other)) >
            kShearTolerance * glm::length(one) * glm::length(other)) {
            return true;
        }
    }
    return false;
}

void checkLastRow(const tinygltf::Node& node,
                  const std::string& pointer,
                  const std::string& name,
                  Warnings& warnings) {
    const glm::dvec4 last_row = glm::transpose(glm::make_mat4(node.matrix.data()))[3];
    const glm::dvec4 off = glm::abs(last_row - glm::dvec4(0, 0, 0, 1));
    if (!(std::max({off.x, off.y, off.z, off.w}) <= kAffineTolerance)) {
        warnings.add(warning::kLastRow, pointer,
                     name + " has a matrix with the last row (" + numberText(last_row.x) + ", " +
                         numberText(last_row.y) + ", " + numberText(last_row.z) + ", " +
                         numberText(last_row.w) + "), which is ignored; expected (0, 0, 0, 1)");
    }
}

} // namespace

void checkRotation(const glm::dquat& rotation,
                   const std::string& pointer,
                   const std::string& name,
                   Warnings& warnings) {
    const double length = glm::length(rotation);
    if (!scene::isDirection(length)) {
        warnings.add(warning::kRotationZero, pointer,
                     name + " has a rotation of length " + numberText(length) +
                         " and is not rotated; expected 1");
    } else if (std::abs(length - 1) > kUnitTolerance) {
        warnings.add(warning::kRotationLength, pointer,
                     name + " has a rotation of length " + numberText(length) +
                         ", which is made 1");
    }
}

scene::Transform nodeParts(const tinygltf::Node& node) {
    const auto& t = node.translation;
    const auto& r = node.rotation;
    const auto& s = node.scale;
    return {.translation = t.empty() ? glm::dvec3(0) : glm::dvec3(t[0], t[1], t[2]),
            .rotation = r.empty() ? glm::dquat(1, 0, 0, 0) : glm::dquat(r[3], r[0], r[1], r[2]),
            .scale = s.empty() ? glm::dvec3(1) : glm::dvec3(s[0], s[1], s[2])};
}

glm::dmat4 nodeMatrix(const tinygltf::Node& node) {
    glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
    for (int column = 0; column < 4; ++column) {
        matrix[column].w = column == 3 ? 1 : 0;
    }
    return matrix;
}

glm::dmat4 nodeTransform(const tinygltf::Node& node, size_t index, Warnings& warnings) {
    const std::string name = thing("node", index);
    const std::string pointer = pointerTo("nodes", index);
    if (node.matrix.empty()) {
        const scene::Transform parts = nodeParts(node);
        checkRotation(parts.rotation, pointer + "/rotation", name, warnings);
        return scene::matrixOf(parts);
    }
    checkLastRow(node, pointer + "/matrix", name, warnings);
    const glm::dmat4 matrix = nodeMatrix(node);
    if (shears(glm::dmat3(matrix))) {
        warnings.add(
            warning::kShear, pointer + "/matrix",
            name +
                " has a matrix that shears; expected a product of translation, rotation and scale");
    }
    return matrix;
}

bool isUsable(const glm::dmat4& world_from_node, size_t index, Warnings& warnings) {
    if (scene::isUsable(world_from_node)) {
        return true;
    }
    const double* values = glm::value_ptr(world_from_node);
    const double* bad = std::find_if(values, values + 16, [](double value) {
        return !(std::abs(value) <= scene::kLargestElement);
    });
    warnings.add(warning::kFarAway, pointerTo("nodes", index),
                 thing("node", index) + " has a world matrix with " + numberText(*bad) +
                     " and is left out; expected transforms whose product stays within 1e15");
    return false;
}

} // namespace froxel::gltf
