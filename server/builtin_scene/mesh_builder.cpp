#include "builtin_scene/mesh_builder.h"

#include "core/assert.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace froxel::builtin_scene {

glm::vec2 planarUv(glm::vec3 position, glm::vec3 normal) {
    const glm::vec3 size = glm::abs(normal);
    if (size.y >= size.x && size.y >= size.z) {
        return normal.y > 0 ? glm::vec2(position.x, position.z)
                            : glm::vec2(position.x, -position.z);
    }
    if (size.x >= size.z) {
        return {normal.x > 0 ? -position.z : position.z, -position.y};
    }
    return {normal.z > 0 ? position.x : -position.x, -position.y};
}

glm::mat4 moved(float x, float y, float z) {
    return glm::translate(glm::mat4(1.0F), glm::vec3(x, y, z));
}

glm::mat4 turnedX(float angle_rad) {
    return glm::rotate(glm::mat4(1.0F), angle_rad, glm::vec3(1, 0, 0));
}

glm::mat4 turnedY(float angle_rad) {
    return glm::rotate(glm::mat4(1.0F), angle_rad, glm::vec3(0, 1, 0));
}

glm::mat4 turnedZ(float angle_rad) {
    return glm::rotate(glm::mat4(1.0F), angle_rad, glm::vec3(0, 0, 1));
}

void MeshBuilder::use(Surface surface) {
    const auto found = std::find_if(parts_.begin(), parts_.end(),
                                    [&](const Part& part) { return part.surface == surface; });
    current_ = static_cast<size_t>(found - parts_.begin());
    if (found == parts_.end()) {
        parts_.push_back({surface, {}, {}});
    }
}

uint32_t MeshBuilder::vertex(const Vertex& vertex) {
    current().vertices.push_back(vertex);
    return static_cast<uint32_t>(current().vertices.size() - 1);
}

void MeshBuilder::triangle(uint32_t a, uint32_t b, uint32_t c) {
    // The poles of a lathe and the corners of a web come as quads with an edge of no length.
    const auto at = [&](uint32_t index) { return current().vertices[index].position; };
    if (at(a) != at(b) && at(b) != at(c) && at(c) != at(a)) {
        current().indices.insert(current().indices.end(), {a, b, c});
    }
}

void MeshBuilder::quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
}

void MeshBuilder::polygon(const std::vector<glm::vec3>& corners) {
    FROXEL_ASSERT(corners.size() >= 3, "a polygon has three corners");
    glm::vec3 area(0);
    for (size_t i = 2; i < corners.size(); ++i) {
        area += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    }
    const glm::vec3 normal = glm::normalize(area);
    const auto first = static_cast<uint32_t>(current().vertices.size());
    for (const glm::vec3& corner : corners) {
        vertex({corner, normal, planarUv(corner, normal)});
    }
    for (uint32_t i = 2; i < corners.size(); ++i) {
        triangle(first, first + i - 1, first + i);
    }
}

void MeshBuilder::sheet(uint32_t columns,
                        uint32_t rows,
                        const std::function<Vertex(uint32_t i, uint32_t j)>& at) {
    const auto first = static_cast<uint32_t>(current().vertices.size());
    for (uint32_t j = 0; j <= rows; ++j) {
        for (uint32_t i = 0; i <= columns; ++i) {
            vertex(at(i, j));
        }
    }
    const uint32_t stride = columns + 1;
    for (uint32_t j = 0; j < rows; ++j) {
        for (uint32_t i = 0; i < columns; ++i) {
            const uint32_t corner = first + j * stride + i;
            quad(corner, corner + 1, corner + 1 + stride, corner + stride);
        }
    }
}

namespace {

constexpr uint32_t faceBit(uint32_t axis, bool high) {
    return 1U << (2 * axis + (high ? 1U : 0U));
}
constexpr bool isHigh(uint32_t corner, uint32_t axis) {
    return ((corner >> axis) & 1U) != 0;
}

glm::vec3 faceNormal(uint32_t axis, bool high) {
    glm::vec3 normal(0);
    normal[static_cast<glm::length_t>(axis)] = high ? 1.0F : -1.0F;
    return normal;
}

struct BevelledBox {
    glm::vec3 min, max;
    float bevel_m;
    uint32_t omit;

    // The vertex at `corner` (a bit an axis) that belongs to the face across `axis`, mapped as on
    // the face across `uv_axis`.
    [[nodiscard]] Vertex at(uint32_t corner, uint32_t axis, uint32_t uv_axis) const {
        Vertex v;
        for (uint32_t k = 0; k < 3; ++k) {
            const auto component = static_cast<glm::length_t>(k);
            const bool high = isHigh(corner, k);
            const bool runs_on = k == axis || (omit & faceBit(k, high)) != 0;
            const float inset = runs_on ? 0.0F : bevel_m;
            v.position[component] = high ? max[component] - inset : min[component] + inset;
        }
        v.normal = faceNormal(axis, isHigh(corner, axis));
        v.uv = planarUv(v.position, faceNormal(uv_axis, isHigh(corner, uv_axis)));
        return v;
    }
};

} // namespace

void MeshBuilder::box(glm::vec3 min, glm::vec3 max, float bevel_m, uint32_t omit, uint32_t joints) {
    // A chamfer shades from one face's normal to the next. It is mapped as one of the two, so its
    // far edge has vertices of its own.
    const BevelledBox box{min, max, bevel_m, omit};
    std::array<std::array<uint32_t, 3>, 8> at{};
    for (uint32_t corner = 0; corner < 8; ++corner) {
        for (uint32_t axis = 0; axis < 3; ++axis) {
            at[corner][axis] = vertex(box.at(corner, axis, axis));
        }
    }
    const auto loop = [&](std::array<uint32_t, 4> v, bool flip) {
        flip ? quad(v[3], v[2], v[1], v[0]) : quad(v[0], v[1], v[2], v[3]);
    };
    for (uint32_t axis = 0; axis < 3; ++axis) {
        const uint32_t b = (axis + 1) % 3;
        const uint32_t c = (axis + 2) % 3;
        for (const bool high : {false, true}) {
            if (((omit | joints) & faceBit(axis, high)) == 0) {
                const uint32_t o = (high ? 1U : 0U) << axis;
                loop({at[o][axis], at[o | 1U << b][axis], at[o | 1U << b | 1U << c][axis],
                      at[o | 1U << c][axis]},
                     !high);
            }
        }
        // The four chamfers that run along this axis.
        for (uint32_t side = 0; side < 4 && bevel_m > 0; ++side) {
            const bool high_b = (side & 1U) != 0;
            const bool high_c = (side & 2U) != 0;
            if ((omit & (faceBit(b, high_b) | faceBit(c, high_c))) == 0) {
                const uint32_t o = (high_b ? 1U << b : 0U) | (high_c ? 1U << c : 0U);
                const uint32_t e = o | 1U << axis;
                const uint32_t far_o = vertex(box.at(o, c, b));
                const uint32_t far_e = vertex(box.at(e, c, b));
                loop({at[o][b], far_o, far_e, at[e][b]}, high_b != high_c);
            }
        }
    }
    for (uint32_t corner = 0; corner < 8 && bevel_m > 0; ++corner) {
        const bool x = isHigh(corner, 0);
        const bool y = isHigh(corner, 1);
        const bool z = isHigh(corner, 2);
        if ((omit & (faceBit(0, x) | faceBit(1, y) | faceBit(2, z))) == 0) {
            const uint32_t v = at[corner][0];
            const uint32_t far_y = vertex(box.at(corner, 1, 0));
            const uint32_t far_z = vertex(box.at(corner, 2, 0));
            (x != y) != z ? triangle(v, far_y, far_z) : triangle(far_z, far_y, v);
        }
    }
}

void MeshBuilder::append(const MeshBuilder& part, const glm::mat4& this_from_part) {
    const glm::mat3 linear(this_from_part);
    const glm::mat3 normals = glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(linear) < 0;
    for (const Part& source : part.parts_) {
        use(source.surface);
        Part& target = current();
        const auto first = static_cast<uint32_t>(target.vertices.size());
        for (const Vertex& v : source.vertices) {
            target.vertices.push_back({glm::vec3(this_from_part * glm::vec4(v.position, 1.0F)),
                                       glm::normalize(normals * v.normal),
                                       mirrored ? glm::vec2(-v.uv.x, v.uv.y) : v.uv});
        }
        for (size_t i = 0; i + 2 < source.indices.size(); i += 3) {
            const uint32_t b = source.indices[i + (mirrored ? 2 : 1)];
            const uint32_t c = source.indices[i + (mirrored ? 1 : 2)];
            triangle(first + source.indices[i], first + b, first + c);
        }
    }
}

void MeshBuilder::warp(const std::function<glm::vec3(glm::vec3)>& map) {
    constexpr float kStep_m = 1.0F / 512.0F;
    for (Part& part : parts_) {
        for (Vertex& v : part.vertices) {
            const glm::vec3 p = v.position;
            glm::mat3 derivative(1.0F);
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                glm::vec3 offset(0);
                offset[axis] = kStep_m;
                derivative[axis] = (map(p + offset) - map(p - offset)) / (2.0F * kStep_m);
            }
            FROXEL_ASSERT(glm::determinant(derivative) > 0, "a warp keeps orientation");
            v.normal = glm::normalize(glm::transpose(glm::inverse(derivative)) * v.normal);
            v.position = map(p);
        }
    }
}

scene::Mesh MeshBuilder::build(std::string name) const {
    scene::Mesh mesh;
    mesh.name = std::move(name);
    for (const Part& part : parts_) {
        if (part.indices.empty()) {
            continue;
        }
        scene::Primitive primitive;
        primitive.material = static_cast<uint32_t>(part.surface);
        for (const Vertex& v : part.vertices) {
            primitive.positions.push_back(v.position);
            primitive.normals.push_back(v.normal);
            primitive.uv0.push_back(v.uv);
            primitive.bounds.add(v.position);
        }
        primitive.indices = part.indices;
        mesh.primitives.push_back(std::move(primitive));
    }
    return mesh;
}

} // namespace froxel::builtin_scene
