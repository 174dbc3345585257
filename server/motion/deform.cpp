#include "motion/deform.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace froxel::motion {

namespace {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 tangent;
};

// What is unit as far as single precision goes stays to the bit: a skin at rest changes nothing.
constexpr double kUnitError = 1e-7;

// In double, where no finite vector overflows.
glm::vec3 unitOr(const glm::dvec3& vector, const glm::vec3& otherwise) {
    const double length = glm::length(vector);
    if (std::abs(length - 1) <= kUnitError) {
        return glm::vec3(vector);
    }
    return length > 0 && std::isfinite(length) ? glm::vec3(vector / length) : otherwise;
}

void morph(std::span<const scene::MorphDelta> deltas,
           std::span<const float> weights,
           Vertex& vertex) {
    Vertex moved = vertex;
    for (const scene::MorphDelta& delta : deltas) {
        const float weight = weights[delta.target];
        moved.position += weight * delta.position;
        moved.normal += weight * delta.normal;
        moved.tangent += weight * delta.tangent;
    }
    vertex = {moved.position, unitOr(glm::dvec3(moved.normal), vertex.normal),
              unitOr(glm::dvec3(moved.tangent), vertex.tangent)};
}

JointMatrix sumOf(std::span<const scene::Influence> influences, const SkinPose& skin) {
    JointMatrix sum{};
    for (const scene::Influence& influence : influences) {
        for (int row = 0; row < 3; ++row) {
            sum.row[row] += influence.weight * skin.joints[influence.joint].row[row];
        }
    }
    return sum;
}

// Moves the vertex; -1 where the sum of the joints mirrors it.
float skinVertex(const JointMatrix& m, Vertex& vertex) {
    const glm::vec3 x(m.row[0]);
    const glm::vec3 y(m.row[1]);
    const glm::vec3 z(m.row[2]);
    const glm::vec4 p(vertex.position, 1);
    vertex.position = {glm::dot(m.row[0], p), glm::dot(m.row[1], p), glm::dot(m.row[2], p)};
    // Cofactors are there for flattened joints too, where the inverse is not.
    const glm::dvec3 n(vertex.normal);
    const glm::dvec3 by_x = glm::cross(glm::dvec3(y), glm::dvec3(z));
    const glm::dvec3 by_y = glm::cross(glm::dvec3(z), glm::dvec3(x));
    const glm::dvec3 by_z = glm::cross(glm::dvec3(x), glm::dvec3(y));
    const double side = glm::dot(glm::dvec3(x), by_x) < 0 ? -1 : 1;
    vertex.normal = unitOr(
        side * glm::dvec3(glm::dot(by_x, n), glm::dot(by_y, n), glm::dot(by_z, n)), vertex.normal);
    const glm::vec3 t = vertex.tangent;
    vertex.tangent = unitOr({glm::dot(x, t), glm::dot(y, t), glm::dot(z, t)}, t);
    return static_cast<float>(side);
}

template <class T>
std::span<const T>
partOf(const std::vector<T>& elements, const std::vector<uint32_t>& first, size_t vertex) {
    return std::span(elements).subspan(first[vertex], first[vertex + 1] - first[vertex]);
}

// Every corner of a triangle is a vertex of its own.
void makeFlat(const scene::Primitive& primitive, PosedVertices& out) {
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const uint32_t* corner = &primitive.indices[i];
        const glm::dvec3 a(out.positions[corner[0]]);
        const glm::dvec3 across = glm::cross(glm::dvec3(out.positions[corner[1]]) - a,
                                             glm::dvec3(out.positions[corner[2]]) - a);
        const double length = glm::length(across);
        for (int k = 0; length > 0 && k < 3; ++k) {
            out.normals[corner[k]] = glm::vec3(across / length);
        }
    }
}

} // namespace

void deform(const scene::Primitive& primitive,
            const scene::Deformation& deformation,
            std::span<const double> weights,
            const SkinPose* skin,
            PosedVertices& out) {
    const size_t count = primitive.positions.size();
    const bool tangents = !primitive.tangents.empty();
    std::vector<float> single;
    std::transform(weights.begin(), weights.end(), std::back_inserter(single),
                   [](double weight) { return static_cast<float>(weight); });
    out.positions.resize(count);
    out.normals.resize(count);
    out.tangents.resize(tangents ? count : 0);
    for (size_t v = 0; v < count; ++v) {
        Vertex vertex{primitive.positions[v], primitive.normals[v],
                      tangents ? glm::vec3(primitive.tangents[v]) : glm::vec3(1, 0, 0)};
        float side = 1;
        if (!deformation.first_delta.empty()) {
            morph(partOf(deformation.deltas, deformation.first_delta, v), single, vertex);
        }
        if (skin != nullptr) {
            side = skinVertex(
                sumOf(partOf(deformation.influences, deformation.first_influence, v), *skin),
                vertex);
        }
        const glm::vec3& p = vertex.position;
        out.positions[v] = std::isfinite(p.x + p.y + p.z) ? p : primitive.positions[v];
        out.normals[v] = vertex.normal;
        if (tangents) {
            out.tangents[v] = glm::vec4(vertex.tangent, primitive.tangents[v].w * side);
        }
    }
    if (deformation.flat_normals) {
        makeFlat(primitive, out);
    }
}

} // namespace froxel::motion
