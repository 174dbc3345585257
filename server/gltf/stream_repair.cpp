#include "gltf/stream_repair.h"

#include "core/finite.h"
#include "gltf/normals.h"

#include <algorithm>

namespace froxel::gltf {
namespace {

// How many were not finite.
template <class Vector>
size_t replace(std::vector<Vector>& stream, const Vector& stand_in) {
    size_t count = 0;
    for (Vector& element : stream) {
        if (!isFinite(element)) {
            element = stand_in;
            ++count;
        }
    }
    return count;
}

void dropTriangles(scene::Primitive& primitive) {
    const auto broken = [&](uint32_t vertex) { return !isFinite(primitive.positions[vertex]); };
    std::vector<uint32_t> kept;
    kept.reserve(primitive.indices.size());
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const auto first = primitive.indices.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::none_of(first, first + 3, broken)) {
            kept.insert(kept.end(), first, first + 3);
        }
    }
    primitive.indices = std::move(kept);
}

struct NotFinite {
    std::string semantic;
    size_t count = 0;
    const char* consequence = "";
};

void tellNotFinite(const NotFinite& found,
                   const std::string& pointer,
                   const std::string& user,
                   Warnings& warnings) {
    if (found.count > 0) {
        warnings.add(warning::kNotFinite, pointer + "/attributes/" + found.semantic,
                     user + " has " + std::to_string(found.count) + " elements of " +
                         found.semantic + " that are not finite; " + found.consequence);
    }
}

} // namespace

void repairStreams(scene::Primitive& primitive,
                   const std::string& pointer,
                   const std::string& user,
                   Warnings& warnings) {
    const auto tell = [&](const char* semantic, size_t count, const char* consequence) {
        tellNotFinite({semantic, count, consequence}, pointer, user, warnings);
    };
    std::vector<glm::vec3>& positions = primitive.positions;
    const auto whole = std::find_if(positions.begin(), positions.end(), isFinite<glm::vec3>);
    if (std::find_if_not(positions.begin(), positions.end(), isFinite<glm::vec3>) !=
        positions.end()) {
        dropTriangles(primitive);
        // Nothing shows these vertices any more, but bounds contain them.
        const glm::vec3 stand_in = whole == positions.end() ? glm::vec3(0) : *whole;
        tell("POSITION", replace(positions, stand_in), "the triangles there are not drawn");
    }
    replace(primitive.normals, glm::vec3(0));
    replace(primitive.tangents, glm::vec4(0));
    tell("COLOR_0", replace(primitive.colors, glm::vec4(1)), "white is used");
}

void repairTexcoords(std::vector<glm::vec2>& texcoords,
                     const std::string& semantic,
                     const std::string& pointer,
                     const std::string& user,
                     Warnings& warnings) {
    tellNotFinite({semantic, replace(texcoords, glm::vec2(0)), "0, 0 is used"}, pointer, user,
                  warnings);
}

void recomputeNormals(scene::Primitive& primitive, const std::vector<uint32_t>& vertices) {
    std::vector<bool> wanted(primitive.positions.size(), false);
    for (const uint32_t vertex : vertices) {
        wanted[vertex] = true;
    }
    std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0));
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const uint32_t* corners = &primitive.indices[i];
        if (!wanted[corners[0]] && !wanted[corners[1]] && !wanted[corners[2]]) {
            continue;
        }
        const glm::dvec3 a(primitive.positions[corners[0]]);
        const glm::dvec3 b(primitive.positions[corners[1]]);
        const glm::dvec3 c(primitive.positions[corners[2]]);
        const glm::dvec3 twice_area = areaNormal(a, b, c);
        for (size_t corner = 0; corner < 3; ++corner) {
            sums[corners[corner]] += twice_area;
        }
    }
    for (const uint32_t vertex : vertices) {
        primitive.normals[vertex] = unitNormal(sums[vertex]);
    }
}

} // namespace froxel::gltf
