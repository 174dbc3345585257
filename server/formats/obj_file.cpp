#include "formats/obj_file.h"

#include "core/text.h"
#include "formats/side_path.h"
#include "formats/srgb.h"
#include "gltf/normals.h"

#include <boost/interprocess/streams/bufferstream.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace froxel::formats {

namespace {

using Stream = boost::interprocess::ibufferstream;

Stream streamOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size(),
            std::ios::in | std::ios::binary};
}

class MaterialFiles final : public tinyobj::MaterialReader {
  public:
    explicit MaterialFiles(const OpenBeside& open) : open_(open) {}

    bool operator()(const std::string& name,
                    std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* by_name,
                    std::string* /*warning*/,
                    std::string* /*error*/) override {
        if (const auto bytes = open_(sidePath(name))) {
            Stream stream = streamOf(*bytes);
            std::string ignored; // of what MTL files say that is not read
            tinyobj::LoadMtl(by_name, materials, &stream, &ignored, &ignored);
        }
        return true;
    }

  private:
    const OpenBeside& open_;
};

glm::vec3 linear(const tinyobj::real_t (&color)[3]) {
    return linearOfSrgb({color[0], color[1], color[2]});
}

// v runs up there and down in glTF.
Image imageOf(const std::string& name, const tinyobj::texture_option_t& option) {
    Image image;
    image.path = sidePath(name);
    image.scale = {option.scale[0], option.scale[1]};
    image.offset = {option.origin_offset[0], 1 - option.scale[1] - option.origin_offset[1]};
    image.clamped = option.clamp;
    return image;
}

void tellUnread(const tinyobj::material_t& from, gltf::Warnings& warnings) {
    const auto tell = [&](const std::string& name, const char* key, const char* instead) {
        if (!name.empty()) {
            warnings.add(warning::kNotRead, "",
                         "material '" + printable(from.name, 240) + "' has " + key +
                             ", which is not read" + instead);
        }
    };
    tell(from.bump_texname, "map_Bump", "; expected norm for a map of normals");
    tell(from.alpha_texname == from.diffuse_texname ? "" : from.alpha_texname, "map_d",
         " where it is another image than map_Kd");
    tell(from.metallic_texname == from.roughness_texname ? "" : from.metallic_texname, "map_Pm",
         " where it is another image than map_Pr");
}

// MTL's shininess as GGX roughness: a Blinn-Phong lobe as wide (Walter et al. 2007, 5.4); and the
// roughness and metalness of the extension by Exocortex.
void setSurface(const tinyobj::material_t& from, Material& material) {
    const bool physical =
        from.roughness > 0 || from.metallic > 0 || !from.roughness_texname.empty();
    if (!physical) {
        const float alpha2 = 2.0F / (2.0F + std::max(0.0F, from.shininess));
        material.roughness = from.illum == 0 || from.illum == 1 ? 1.0F : std::pow(alpha2, 0.25F);
        return;
    }
    const bool image = !from.roughness_texname.empty();
    const bool both = image && from.metallic_texname == from.roughness_texname;
    material.roughness =
        image && from.roughness == 0 ? 1.0F : std::clamp(from.roughness, 0.0F, 1.0F);
    material.metallic = both && from.metallic == 0 ? 1.0F : std::clamp(from.metallic, 0.0F, 1.0F);
    material.roughness_image = imageOf(from.roughness_texname, from.roughness_texopt);
}

Material materialOf(const tinyobj::material_t& from, gltf::Warnings& warnings) {
    constexpr float kKdOfNone = 0.6F; // tinyobjloader's, where there is map_Kd alone
    Material material;
    material.name = from.name;
    const glm::vec3 diffuse(from.diffuse[0], from.diffuse[1], from.diffuse[2]);
    const bool white = !from.diffuse_texname.empty() &&
                       (diffuse == glm::vec3(kKdOfNone) || diffuse == glm::vec3(0.0F));
    material.base_color = {white ? glm::vec3(1.0F) : linear(from.diffuse),
                           std::clamp(from.dissolve, 0.0F, 1.0F)};
    material.cut_out = !from.alpha_texname.empty() && from.alpha_texname == from.diffuse_texname;
    material.emissive =
        from.emissive_texname.empty() ||
                glm::vec3(from.emission[0], from.emission[1], from.emission[2]) != glm::vec3(0.0F)
            ? linear(from.emission)
            : glm::vec3(1.0F);
    material.base_color_image = imageOf(from.diffuse_texname, from.diffuse_texopt);
    material.emissive_image = imageOf(from.emissive_texname, from.emissive_texopt);
    material.normal_image = imageOf(from.normal_texname, from.normal_texopt);
    setSurface(from, material);
    tellUnread(from, warnings);
    return material;
}

// What the file's lists hold, checked.
class Lists {
  public:
    explicit Lists(const tinyobj::attrib_t& from) : from_(from) {}

    [[nodiscard]] glm::vec3 position(size_t face, int index) const {
        return vector(from_.vertices, check(face, index, from_.vertices.size() / 3, "vertex"));
    }
    [[nodiscard]] glm::vec3 normal(size_t face, int index) const {
        return vector(from_.normals, check(face, index, from_.normals.size() / 3, "normal"));
    }
    [[nodiscard]] glm::vec2 texcoord(size_t face, int index) const {
        const size_t at = 2 * check(face, index, from_.texcoords.size() / 2, "texture coordinate");
        return {from_.texcoords[at], 1 - from_.texcoords[at + 1]};
    }
    [[nodiscard]] bool hasColors() const {
        return !from_.vertices.empty() && from_.colors.size() == from_.vertices.size();
    }
    [[nodiscard]] glm::vec4 color(int index) const {
        const auto srgb = vector(from_.colors, static_cast<size_t>(index));
        return {linearOfSrgb(srgb), 1.0F};
    }

  private:
    static size_t check(size_t face, int index, size_t count, const char* thing) {
        if (index < 0 || static_cast<size_t>(index) >= count) {
            gltf::fail("face " + std::to_string(face) + " uses " + thing + " " +
                       std::to_string(int64_t{index} + 1) + "; the file has " +
                       std::to_string(count));
        }
        return static_cast<size_t>(index);
    }
    static glm::vec3 vector(const std::vector<tinyobj::real_t>& list, size_t index) {
        return {list[3 * index], list[3 * index + 1], list[3 * index + 2]};
    }

    const tinyobj::attrib_t& from_;
};

// Normals of the faces that have none: of a smoothing group each vertex has one, by area.
class SmoothingGroups {
  public:
    void add(unsigned group, int vertex, const glm::dvec3& normal) {
        sums_.try_emplace({group, vertex}, 0.0).first->second += normal;
    }
    [[nodiscard]] glm::dvec3 normal(unsigned group, int vertex) const {
        return sums_.at({group, vertex});
    }

  private:
    std::map<std::pair<unsigned, int>, glm::dvec3> sums_;
};

// A shape's triangles as parts, one for each material.
class ShapeParts {
  public:
    ShapeParts(const tinyobj::mesh_t& mesh, const Lists& lists, size_t first_face)
        : mesh_(mesh), lists_(lists), first_face_(first_face) {}

    [[nodiscard]] std::vector<Part> make(size_t default_material) {
        const size_t count = mesh_.indices.size() / 3;
        for (size_t face = 0; face < count; ++face) {
            const unsigned group = mesh_.smoothing_group_ids[face];
            for (size_t corner = 0; group != 0 && corner < 3; ++corner) {
                groups_.add(group, index(face, corner).vertex_index, normalOfFace(face));
            }
        }
        for (size_t face = 0; face < count; ++face) {
            const int material = mesh_.material_ids[face];
            addFace(face, material < 0 ? default_material : static_cast<size_t>(material));
        }
        std::vector<Part> parts;
        for (auto& [material, made] : made_) {
            parts.push_back(std::move(made.part));
        }
        return parts;
    }

  private:
    // Vertex, texture coordinate, normal; the face, where it gives the normal.
    using Key = std::tuple<int, int, int, size_t>;
    struct Made {
        Part part;
        std::map<Key, uint32_t> known;
    };

    [[nodiscard]] const tinyobj::index_t& index(size_t face, size_t corner) const {
        return mesh_.indices[3 * face + corner];
    }

    [[nodiscard]] glm::dvec3 normalOfFace(size_t face) const {
        const auto at = [&](size_t corner) {
            return lists_.position(first_face_ + face, index(face, corner).vertex_index);
        };
        return gltf::areaNormal(at(0), at(1), at(2));
    }

    [[nodiscard]] glm::vec3 normalOf(size_t face, const tinyobj::index_t& corner) const {
        if (corner.normal_index >= 0) {
            return lists_.normal(first_face_ + face, corner.normal_index);
        }
        const unsigned group = mesh_.smoothing_group_ids[face];
        return gltf::unitNormal(group != 0 ? groups_.normal(group, corner.vertex_index)
                                           : normalOfFace(face));
    }

    void addFace(size_t face, size_t material) {
        Made& made = made_[material];
        made.part.material = material;
        for (size_t i = 0; i < 3; ++i) {
            const tinyobj::index_t& corner = index(face, i);
            const bool own = corner.normal_index >= 0;
            const unsigned group = own ? 0 : mesh_.smoothing_group_ids[face];
            const Key key{corner.vertex_index, corner.texcoord_index,
                          own ? corner.normal_index : -1 - static_cast<int>(group),
                          own || group != 0 ? 0 : face + 1};
            const auto [known, is_new] =
                made.known.emplace(key, static_cast<uint32_t>(made.part.positions.size()));
            if (is_new) {
                addVertex(face, corner, made.part);
            }
            made.part.indices.push_back(known->second);
        }
    }

    void addVertex(size_t face, const tinyobj::index_t& corner, Part& part) const {
        part.positions.push_back(lists_.position(first_face_ + face, corner.vertex_index));
        part.normals.push_back(normalOf(face, corner));
        if (lists_.hasColors()) {
            part.colors.push_back(lists_.color(corner.vertex_index));
        }
        if (corner.texcoord_index >= 0) {
            part.texcoords.resize(part.positions.size() - 1);
            part.texcoords.push_back(lists_.texcoord(first_face_ + face, corner.texcoord_index));
        } else if (!part.texcoords.empty()) {
            part.texcoords.resize(part.positions.size());
        }
    }

    const tinyobj::mesh_t& mesh_;
    const Lists& lists_;
    const size_t first_face_; // for messages
    SmoothingGroups groups_;
    std::map<size_t, Made> made_; // by material
};

void checkMaterials(const std::vector<tinyobj::shape_t>& shapes, size_t count) {
    for (const tinyobj::shape_t& shape : shapes) {
        for (const int material : shape.mesh.material_ids) {
            if (material >= 0 && static_cast<size_t>(material) >= count) {
                gltf::fail("a face uses material " + std::to_string(material) + "; the file has " +
                           std::to_string(count));
            }
        }
    }
}

} // namespace

Model readObj(std::span<const std::byte> file, const OpenBeside& open, gltf::Warnings& warnings) {
    Stream stream = streamOf(file);
    MaterialFiles material_files(open);
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning;
    std::string error;
    constexpr bool kTriangulate = true;
    constexpr bool kWhiteWhereNoColors = false;
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream,
                          &material_files, kTriangulate, kWhiteWhereNoColors)) {
        gltf::fail("it is no OBJ file: " + printable(error, 200));
    }
    checkMaterials(shapes, materials.size());
    Model model;
    for (const tinyobj::material_t& material : materials) {
        model.materials.push_back(materialOf(material, warnings));
    }
    const Lists lists(attributes);
    Material plain;
    if (lists.hasColors()) {
        plain.base_color = glm::vec4(1.0F);
    }
    model.materials.push_back(plain);
    size_t first_face = 0;
    size_t undrawn = 0;
    for (const tinyobj::shape_t& shape : shapes) {
        auto parts = ShapeParts(shape.mesh, lists, first_face).make(materials.size());
        first_face += shape.mesh.indices.size() / 3;
        undrawn += shape.lines.num_line_vertices.size() + shape.points.indices.size();
        if (!parts.empty()) {
            model.placed.push_back({.mesh = model.meshes.size()});
            model.meshes.push_back({shape.name, std::move(parts)});
        }
    }
    if (model.meshes.empty()) {
        gltf::fail("it has no faces; expected an OBJ file with some");
    }
    if (undrawn > 0) {
        warnings.add(warning::kNotRead, "",
                     std::to_string(undrawn) + " lines and points are not drawn");
    }
    return model;
}

} // namespace froxel::formats
