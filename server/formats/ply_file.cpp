#include "formats/ply_file.h"

#include "core/text.h"
#include "formats/ply_data.h"
#include "formats/side_path.h"
#include "formats/srgb.h"
#include "gltf/normals.h"
#include "gltf/triangles.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

namespace froxel::formats {

namespace {

// Which of an element's properties has one of these names; none: kNone.
constexpr size_t kNone = std::numeric_limits<size_t>::max();
size_t placeOf(const PlyElement& element, std::initializer_list<std::string_view> names) {
    const auto found = std::ranges::find_if(element.properties, [&](const PlyProperty& property) {
        return std::ranges::find(names, property.name) != names.end();
    });
    return found == element.properties.end()
               ? kNone
               : static_cast<size_t>(found - element.properties.begin());
}

// What an integer has where a number from 0 to 1 is meant.
double spanOf(PlyType type) {
    return ofPlyType(type, []<class T>(T) {
        return std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
    });
}

// Of each vertex, by the areas of its triangles.
std::vector<glm::vec3> smoothNormals(const Part& part) {
    std::vector<glm::dvec3> sums(part.positions.size(), glm::dvec3(0));
    for (size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const uint32_t* const corners = &part.indices[i];
        const glm::dvec3 normal = gltf::areaNormal(
            part.positions[corners[0]], part.positions[corners[1]], part.positions[corners[2]]);
        for (size_t corner = 0; corner < 3; ++corner) {
            sums[corners[corner]] += normal;
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(sums.size());
    std::ranges::transform(sums, std::back_inserter(normals), gltf::unitNormal);
    return normals;
}

// An element's items, one after the other.
class Items {
  public:
    Items(PlyNumbers& numbers, const PlyElement& element)
        : numbers_(numbers), element_(element), values_(element.properties.size()),
          lists_(element.properties.size()) {
        // Each takes a byte at least.
        if (!element.properties.empty() && element.count > numbers.left()) {
            gltf::fail("it has " + std::to_string(element.count) + " of '" +
                       printable(element.name) + "' in " + std::to_string(numbers.left()) +
                       " bytes");
        }
    }

    [[nodiscard]] size_t count() const { return element_.properties.empty() ? 0 : element_.count; }

    void readNext() {
        for (size_t i = 0; i < values_.size(); ++i) {
            const PlyProperty& property = element_.properties[i];
            if (!property.length) {
                values_[i] = numbers_.next(property.type);
                continue;
            }
            lists_[i].resize(numbers_.nextLength(*property.length));
            for (double& number : lists_[i]) {
                number = numbers_.next(property.type);
            }
        }
    }

    [[nodiscard]] float value(size_t place) const { return static_cast<float>(values_[place]); }
    [[nodiscard]] const std::vector<double>& list(size_t place) const { return lists_[place]; }

    // From 0 to 1.
    [[nodiscard]] double share(size_t place) const {
        return values_[place] / spanOf(element_.properties[place].type);
    }

  private:
    PlyNumbers& numbers_;
    const PlyElement& element_;
    std::vector<double> values_; // by property
    std::vector<std::vector<double>> lists_;
};

bool hasAll(const auto& places) {
    return std::ranges::find(places, kNone) == places.end();
}

void readVertices(Items items, const PlyElement& element, Part& part) {
    const std::array position{placeOf(element, {"x"}), placeOf(element, {"y"}),
                              placeOf(element, {"z"})};
    const std::array normal{placeOf(element, {"nx"}), placeOf(element, {"ny"}),
                            placeOf(element, {"nz"})};
    const std::array texcoord{placeOf(element, {"u", "s", "texture_u"}),
                              placeOf(element, {"v", "t", "texture_v"})};
    const std::array color{placeOf(element, {"red", "r", "diffuse_red"}),
                           placeOf(element, {"green", "g", "diffuse_green"}),
                           placeOf(element, {"blue", "b", "diffuse_blue"})};
    const size_t alpha = placeOf(element, {"alpha", "a"});
    if (!hasAll(position)) {
        gltf::fail("its vertices lack x, y or z");
    }
    const auto vector = [&items](const std::array<size_t, 3>& of) {
        return glm::vec3(items.value(of[0]), items.value(of[1]), items.value(of[2]));
    };
    for (size_t i = 0; i < items.count(); ++i) {
        items.readNext();
        part.positions.push_back(vector(position));
        if (hasAll(normal)) {
            part.normals.push_back(vector(normal));
        }
        if (hasAll(texcoord)) {
            part.texcoords.emplace_back(items.value(texcoord[0]), 1 - items.value(texcoord[1]));
        }
        if (hasAll(color)) {
            const glm::dvec3 srgb(items.share(color[0]), items.share(color[1]),
                                  items.share(color[2]));
            part.colors.emplace_back(linearOfSrgb(srgb),
                                     alpha == kNone ? 1.0
                                                    : std::clamp(items.share(alpha), 0.0, 1.0));
        }
    }
}

// Polygons as fans; into `corner_texcoords`: of each index, where faces have them.
void readFaces(Items items,
               const PlyElement& element,
               Part& part,
               std::vector<glm::vec2>& corner_texcoords) {
    const size_t corners = placeOf(element, {"vertex_indices", "vertex_index"});
    const size_t texcoords = placeOf(element, {"texcoord"});
    if (corners == kNone || !element.properties[corners].length) {
        gltf::fail("its faces lack a list of vertex_indices");
    }
    for (size_t i = 0; i < items.count(); ++i) {
        items.readNext();
        const std::vector<double>& polygon = items.list(corners);
        const auto add = [&](size_t corner) {
            const double vertex = polygon[corner];
            if (!(vertex >= 0 && vertex < static_cast<double>(part.positions.size()))) {
                gltf::fail("face " + std::to_string(i) + " has vertex " + numberText(vertex) +
                           "; the file has " + std::to_string(part.positions.size()) +
                           " before its faces");
            }
            part.indices.push_back(static_cast<uint32_t>(vertex));
            if (texcoords != kNone) {
                const std::vector<double>& uv = items.list(texcoords);
                const bool has = uv.size() >= 2 * polygon.size();
                corner_texcoords.push_back(has ? glm::vec2(uv[2 * corner], 1 - uv[2 * corner + 1])
                                               : glm::vec2(0.0F));
            }
        };
        for (size_t corner = 2; corner < polygon.size(); ++corner) {
            add(0);
            add(corner - 1);
            add(corner);
        }
    }
}

// A vertex for each corner.
void spread(Part& part, std::vector<glm::vec2> corner_texcoords) {
    part.positions = gltf::unshared(part.positions, part.indices);
    part.normals = gltf::unshared(part.normals, part.indices);
    part.colors = gltf::unshared(part.colors, part.indices);
    part.texcoords = std::move(corner_texcoords);
    part.indices.clear();
}

} // namespace

Model readPly(std::span<const std::byte> file) {
    const PlyHeader header =
        readPlyHeader({reinterpret_cast<const char*>(file.data()), file.size()});
    PlyNumbers numbers(file, header);
    Part part;
    std::vector<glm::vec2> corner_texcoords;
    for (const PlyElement& element : header.elements) {
        Items items(numbers, element);
        if (element.name == "vertex") {
            readVertices(std::move(items), element, part);
        } else if (element.name == "face") {
            readFaces(std::move(items), element, part, corner_texcoords);
        } else {
            for (size_t item = 0; item < items.count(); ++item) {
                items.readNext();
            }
        }
    }
    if (part.indices.empty()) {
        gltf::fail("it has " + std::to_string(part.positions.size()) +
                   " vertices and no faces; points are not drawn");
    }
    if (part.normals.empty()) {
        part.normals = smoothNormals(part);
    }
    if (!corner_texcoords.empty()) {
        spread(part, std::move(corner_texcoords));
    }
    Model model;
    Material& material = model.materials.emplace_back();
    material.base_color_image.path = part.texcoords.empty() ? "" : sidePath(header.texture_file);
    if (!part.colors.empty() || !material.base_color_image.path.empty()) {
        material.base_color = glm::vec4(1.0F);
    }
    model.meshes.push_back({"", {std::move(part)}});
    model.placed.emplace_back();
    return model;
}

} // namespace froxel::formats
