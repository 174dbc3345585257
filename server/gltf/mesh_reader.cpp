#include "gltf/mesh_reader.h"

#include "core/text.h"
#include "gltf/extension_value.h"
#include "gltf/failure.h"
#include "gltf/stream_repair.h"
#include "gltf/tangent_space.h"
#include "gltf/triangles.h"
#include "gltf/variant_reader.h"
#include "gltf/vertex_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

namespace froxel::gltf {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

// nullopt for points, lines and what glTF does not know.
std::optional<Topology> topologyOf(int mode) {
    switch (mode) {
    case TINYGLTF_MODE_TRIANGLES:
        return Topology::kTriangles;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return Topology::kStrip;
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return Topology::kFan;
    default:
        return std::nullopt;
    }
}

std::vector<glm::vec4> readColors(VertexSource& source, int components, size_t count) {
    std::vector<glm::vec4> colors;
    if (components == 4) {
        colors = source.vectors<4>("COLOR_0", count);
    } else {
        const std::vector<glm::vec3> opaque = source.vectors<3>("COLOR_0", count);
        colors.assign(opaque.size(), glm::vec4(1));
        std::transform(opaque.begin(), opaque.end(), colors.begin(),
                       [](const glm::vec3& rgb) { return glm::vec4(rgb, 1); });
    }
    for (glm::vec4& color : colors) {
        color = glm::clamp(color, 0.0F, 1.0F); // the specification says so
    }
    return colors;
}

// Normalises in double, where no finite float overflows; false where there is no direction.
bool makeUnit(glm::vec3& vector) {
    const glm::dvec3 exact(vector);
    const double length = glm::length(exact);
    if (!(length > 0)) {
        return false;
    }
    vector = glm::vec3(exact / length);
    return true;
}

// The set of coordinates that tangents of these materials go by; none where no texture asks for
// tangents, where several ask for different ones, or where one is turned or mirrored on its way to
// the surface, which the tangents would not follow.
std::optional<uint32_t> tangentTexcoord(std::span<const scene::Material* const> materials) {
    std::optional<uint32_t> texcoord;
    for (const scene::Material* material : materials) {
        for (const scene::TextureSlot* slot :
             {&material->normal_texture, &material->coat_normal_texture,
              &material->anisotropy_texture}) {
            if (slot->texture == scene::kNone) {
                continue;
            }
            if (slot->rotation_rad != 0 || slot->scale.x <= 0 || slot->scale.y <= 0 ||
                texcoord.value_or(slot->texcoord) != slot->texcoord) {
                return std::nullopt;
            }
            texcoord = slot->texcoord;
        }
    }
    return texcoord;
}

} // namespace

MeshReader::MeshReader(const Document& document,
                       BufferViews& views,
                       AccessorReader& accessors,
                       MaterialReader& materials,
                       scene::Scene& scene,
                       ReadMemory& memory,
                       Warnings& warnings)
    : document_(document), views_(views), accessors_(accessors), materials_(materials),
      scene_(scene), warnings_(warnings), target_counts_(document.model.meshes.size()),
      primitives_("primitives", kMaxPrimitives, kPrimitiveBytes, memory),
      vertices_("vertices", kMaxVertices, kVertexBytes, memory),
      indices_("indices", kMaxIndices, kIndexBytes, memory),
      deformations_(accessors, memory, warnings) {}

uint32_t MeshReader::mesh(int index, const std::vector<double>& weights, const std::string& user) {
    const size_t number = checkedIndex(index, document_.model.meshes.size(), "mesh", user);
    const std::pair key(index, weights);
    const auto known = known_.find(key);
    if (known != known_.end()) {
        return known->second;
    }
    const uint32_t position = add(number, {weights, {}});
    known_.emplace(key, position);
    return position;
}

void MeshReader::tellUndrawn() {
    if (!undrawn_.empty()) {
        const auto [mesh, number] = *undrawn_.begin();
        warnings_.add(warning::kNoTriangles,
                      pointerTo("meshes", mesh) + pointerTo("primitives", number),
                      std::to_string(undrawn_.size()) +
                          (undrawn_.size() == 1 ? " primitive is" : " primitives are") +
                          " points or lines and not drawn");
    }
}

uint32_t MeshReader::deformingMesh(int index,
                                   const std::vector<double>& weights,
                                   const MeshMotion& motion,
                                   std::vector<scene::Deformation>& out,
                                   const std::string& user) {
    const size_t number = checkedIndex(index, document_.model.meshes.size(), "mesh", user);
    return add(number, {weights, motion, &out});
}

size_t MeshReader::targetCount(int index, const std::string& user) {
    const auto& meshes = document_.model.meshes;
    const size_t mesh = checkedIndex(index, meshes.size(), "mesh", user);
    std::optional<size_t>& count = target_counts_[mesh];
    if (!count) {
        count = 0;
        for (const auto& primitive : meshes[mesh].primitives) {
            count = std::max(*count, primitive.targets.size());
        }
    }
    return *count;
}

uint32_t MeshReader::add(size_t index, const Use& use) {
    const tinygltf::Mesh& source = document_.model.meshes[index];
    primitives_.take(source.primitives.size(), thing("mesh", index));
    scene::Mesh mesh;
    mesh.name = source.name;
    for (size_t i = 0; i < source.primitives.size(); ++i) {
        if (auto primitive = readPrimitive(index, i, use)) {
            mesh.primitives.push_back(std::move(*primitive));
        }
    }
    if (mesh.primitives.empty()) {
        return scene::kNone;
    }
    scene_.meshes.push_back(std::move(mesh));
    return static_cast<uint32_t>(scene_.meshes.size() - 1);
}

std::optional<scene::Primitive>
MeshReader::readPrimitive(size_t mesh, size_t number, const Use& use) {
    const tinygltf::Primitive& source = document_.model.meshes[mesh].primitives[number];
    const std::string user = thing("mesh", mesh) + " " + thing("primitive", number);
    const std::optional<Topology> topology = topologyOf(source.mode);
    const std::string pointer = pointerTo("meshes", mesh) + pointerTo("primitives", number);
    if (source.mode < TINYGLTF_MODE_POINTS || source.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        warnings_.add(warning::kUnknownMode, pointer + "/mode",
                      user + " has mode " + std::to_string(source.mode) +
                          " and is not drawn; expected 0 to 6");
        return std::nullopt;
    }
    if (!topology) {
        undrawn_.emplace(mesh, number);
        return std::nullopt;
    }
    if (!source.attributes.contains("POSITION")) {
        warnings_.add(warning::kNoPosition, pointer, user + " has no POSITION and is not drawn");
        return std::nullopt;
    }
    const int index_accessor = document_.indices[mesh][number];
    uint64_t vertex_count = accessors_.count(source.attributes.at("POSITION"), user);
    uint64_t index_count =
        index_accessor < 0 ? vertex_count : accessors_.count(index_accessor, user);
    const auto draco = openDraco(source, vertex_count, index_count, pointer, user);
    const uint64_t list_length = listLength(*topology, index_count);
    if (list_length == 0) {
        warnings_.add(warning::kCountOff, pointer,
                      user + " has no whole triangle and is not drawn");
        return std::nullopt;
    }
    if (*topology == Topology::kTriangles && list_length != index_count) {
        warnings_.add(warning::kCountOff, pointer,
                      user + " has " + std::to_string(index_count) +
                          " indices, which is not a multiple of 3; the last ones are ignored");
    }
    if (draco == nullptr) {
        vertices_.take(vertex_count, user);
        indices_.take(std::max(list_length, index_count), user);
    }
    VertexSource stream(source, accessors_, draco.get(), user);
    scene::Primitive primitive;
    primitive.positions = stream.vectors<3>("POSITION", vertex_count);
    primitive.indices = triangleList(
        *topology, readIndices(source, index_accessor, draco.get(), vertex_count, user));
    readStreams(stream, primitive, pointer, user);
    repairStreams(primitive, pointer, user, warnings_);
    if (primitive.indices.empty()) {
        return std::nullopt;
    }
    readMaterials(source, stream, primitive, pointer, user);
    readMotion(source, stream, use, primitive, pointer, user);
    finishNormals(stream.has("NORMAL"), primitive, pointer, user);
    finishTangents(primitive, pointer, user);
    makeTangents(use, primitive, user);
    for (const glm::vec3& position : primitive.positions) {
        primitive.bounds.add(position);
    }
    return primitive;
}

// The counts become those of the stream, which wins where accessors say others: a loader "must use
// the decompressed data" (KHR_draco_mesh_compression). Blender's exporters up to 1.2.75 counted
// before they compressed.
std::unique_ptr<DracoMesh> MeshReader::openDraco(const tinygltf::Primitive& source,
                                                 uint64_t& vertex_count,
                                                 uint64_t& index_count,
                                                 const std::string& pointer,
                                                 const std::string& user) {
    const tinygltf::Value* extension = findExtension(source.extensions, kDraco);
    if (extension == nullptr) {
        return nullptr;
    }
    std::map<std::string, int> ids;
    const tinygltf::Value& attributes = extension->Get("attributes");
    for (const std::string& semantic : attributes.Keys()) {
        ids[semantic] = attributes.Get(semantic).GetNumberAsInt();
    }
    const auto stream = views_.bytes(intOr(*extension, "bufferView", -1), user);
    const DracoCounts counts = readDracoCounts(stream, user);
    vertices_.take(counts.vertices, user);
    indices_.take(counts.triangles * 3, user);
    auto mesh = std::make_unique<DracoMesh>(stream, std::move(ids), user);
    const uint64_t vertices = mesh->vertexCount();
    const uint64_t indices = mesh->triangleCount() * 3;
    vertices_.take(vertices - std::min(vertices, counts.vertices), user);
    if (vertices != vertex_count || indices != index_count) {
        warnings_.add(warning::kDracoCounts, pointer + "/extensions/" + kDraco,
                      user + " has " + std::to_string(vertex_count) + " vertices and " +
                          std::to_string(index_count) + " indices by its accessors, but " +
                          std::to_string(vertices) + " and " + std::to_string(indices) +
                          " in its Draco stream, which is drawn");
    }
    vertex_count = vertices;
    index_count = indices;
    return mesh;
}

void MeshReader::readMaterials(const tinygltf::Primitive& source,
                               VertexSource& stream,
                               scene::Primitive& primitive,
                               const std::string& pointer,
                               const std::string& user) {
    const auto variants =
        variantMaterials(source, scene_.material_variants.size(), pointer, user, warnings_);
    std::vector<uint32_t> sets;
    const auto read = [&](int index) {
        const uint32_t material = materials_.material(index, pointer, user);
        for (const uint32_t set : materials_.texcoordSets(material)) {
            if (std::ranges::find(sets, set) == sets.end()) {
                sets.push_back(set);
            }
        }
        return material;
    };
    primitive.material = read(source.material);
    for (const auto& [variant, material] : variants) {
        primitive.variant_materials.push_back({variant, read(material)});
    }
    const TexcoordPlaces places = readTexcoords(sets, stream, primitive, pointer, user);
    primitive.material = materials_.withTexcoords(primitive.material, places, pointer, user);
    for (scene::VariantMaterial& of : primitive.variant_materials) {
        of.material = materials_.withTexcoords(of.material, places, pointer, user);
    }
}

TexcoordPlaces MeshReader::readTexcoords(const std::vector<uint32_t>& sets,
                                         VertexSource& source,
                                         scene::Primitive& primitive,
                                         const std::string& pointer,
                                         const std::string& user) {
    // Usually both are read, each into its own: what has no texture may still have a direction.
    const bool usual = std::ranges::all_of(sets, [](uint32_t set) { return set < 2; });
    const std::array streams = {&primitive.uv0, &primitive.uv1};
    const auto placeOf = [&](uint32_t set, const std::vector<glm::vec2>& texcoords) {
        uint32_t place = usual ? set : 0;
        while (!usual && place < streams.size() && !streams[place]->empty() &&
               *streams[place] != texcoords) {
            ++place;
        }
        return place;
    };
    TexcoordPlaces places;
    for (const uint32_t set : usual ? std::vector{0U, 1U} : sets) {
        const std::string semantic = "TEXCOORD_" + std::to_string(set);
        std::vector<glm::vec2> texcoords;
        readStream(source, semantic, pointer,
                   [&] { texcoords = source.vectors<2>(semantic, primitive.positions.size()); });
        if (texcoords.empty()) {
            continue;
        }
        repairTexcoords(texcoords, semantic, pointer, user, warnings_);
        const uint32_t place = placeOf(set, texcoords);
        if (place == streams.size()) {
            warnings_.add(warning::kThirdTexcoord, pointer + "/attributes/" + semantic,
                          user + " has " + semantic +
                              " as the third set of coordinates of its material; it is left out, "
                              "because two sets are supported");
            continue;
        }
        *streams[place] = std::move(texcoords);
        places[set] = place;
    }
    return places;
}

void MeshReader::makeTangents(const Use& use,
                              scene::Primitive& primitive,
                              const std::string& user) {
    if (!primitive.tangents.empty() || primitive.indices.size() > kMostTangentCorners ||
        (use.deformations != nullptr && (use.deformations->back().flat_normals ||
                                         !use.deformations->back().first_delta.empty()))) {
        return;
    }
    std::vector<const scene::Material*> materials = {&scene_.materials[primitive.material]};
    for (const scene::VariantMaterial& of : primitive.variant_materials) {
        materials.push_back(&scene_.materials[of.material]);
    }
    const auto texcoord = tangentTexcoord(materials);
    if (!texcoord) {
        return;
    }
    const auto& uv = *texcoord == 0 ? primitive.uv0 : primitive.uv1;
    const auto copies = addTangents(primitive, cornerTangents(primitive, uv));
    vertices_.take(copies.size(), user);
    if (use.deformations != nullptr) {
        deformations_.addCopies(copies, use.deformations->back());
    }
}

std::vector<uint32_t> MeshReader::readIndices(const tinygltf::Primitive& source,
                                              int accessor,
                                              const DracoMesh* draco,
                                              size_t vertex_count,
                                              const std::string& user) {
    std::vector<uint32_t> indices;
    if (draco != nullptr) {
        if (source.mode != TINYGLTF_MODE_TRIANGLES) {
            fail(user + " is compressed by Draco with mode " + std::to_string(source.mode) +
                 "; expected 4");
        }
        indices = draco->indices();
    } else if (accessor >= 0) {
        indices = accessors_.indices(accessor, user + " indices");
    } else {
        indices.resize(vertex_count);
        std::iota(indices.begin(), indices.end(), 0U);
    }
    for (size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertex_count) {
            fail(user + " index " + std::to_string(i) + " is " + std::to_string(indices[i]) +
                 "; expected below " + std::to_string(vertex_count) + ", its vertices");
        }
    }
    return indices;
}

void MeshReader::readStream(VertexSource& source,
                            const std::string& semantic,
                            const std::string& pointer,
                            const std::function<void()>& read) {
    if (!source.has(semantic)) {
        return;
    }
    try {
        read();
    } catch (const Failure& failure) {
        source.leaveOut(semantic);
        warnings_.add(warning::kNoStream, pointer + "/attributes/" + semantic,
                      failure.what() + std::string("; it is left out"));
    }
}

void MeshReader::readStreams(VertexSource& source,
                             scene::Primitive& primitive,
                             const std::string& pointer,
                             const std::string& user) {
    const size_t count = primitive.positions.size();
    const auto read = [&](const char* semantic, auto& stream, const auto& vectors) {
        readStream(source, semantic, pointer, [&] { stream = vectors(semantic); });
    };
    read("NORMAL", primitive.normals,
         [&](const char* semantic) { return source.vectors<3>(semantic, count); });
    if (!source.has("NORMAL") && primitive.indices.size() > count) {
        vertices_.take(primitive.indices.size() - count, user); // each triangle has its own
    } else if (source.has("NORMAL")) {
        read("TANGENT", primitive.tangents,
             [&](const char* semantic) { return source.vectors<4>(semantic, count); });
    }
    read("COLOR_0", primitive.colors, [&](const char* semantic) {
        const int components = accessors_.components(source.accessor(semantic), user);
        return readColors(source, components, count);
    });
}

void MeshReader::readMotion(const tinygltf::Primitive& source,
                            VertexSource& stream,
                            const Use& use,
                            scene::Primitive& primitive,
                            const std::string& pointer,
                            const std::string& user) {
    if (use.deformations == nullptr || !use.motion.morphs) {
        deformations_.applyTargets(source.targets, use.weights, primitive, user);
    }
    if (use.deformations == nullptr) {
        return;
    }
    scene::Deformation& deformation = use.deformations->emplace_back();
    if (use.motion.joint_count) {
        deformations_.readInfluences(stream, primitive, *use.motion.joint_count, deformation,
                                     pointer, user);
    }
    if (use.motion.morphs && !source.targets.empty()) {
        deformations_.readTargets(source.targets, primitive, deformation, user);
    }
    if (!stream.has("NORMAL")) {
        deformations_.makeFlat(primitive.indices, deformation);
    }
}

void MeshReader::finishNormals(bool has_normals,
                               scene::Primitive& primitive,
                               const std::string& pointer,
                               const std::string& user) {
    if (!has_normals) {
        vertices_.take(primitive.indices.size(), user);
        makeFlat(primitive);
        return;
    }
    std::vector<uint32_t> broken;
    for (size_t i = 0; i < primitive.normals.size(); ++i) {
        if (!makeUnit(primitive.normals[i])) {
            broken.push_back(static_cast<uint32_t>(i));
        }
    }
    if (!broken.empty()) {
        recomputeNormals(primitive, broken);
        warnings_.add(
            warning::kLengthZero, pointer + "/attributes/NORMAL",
            user + " has " + std::to_string(broken.size()) +
                " normals of length 0 or not finite; the surrounding triangles replace them");
    }
}

void MeshReader::finishTangents(scene::Primitive& primitive,
                                const std::string& pointer,
                                const std::string& user) {
    for (glm::vec4& tangent : primitive.tangents) {
        glm::vec3 direction(tangent);
        if (!makeUnit(direction) || tangent.w == 0) {
            warnings_.add(warning::kLengthZero, pointer + "/attributes/TANGENT",
                          user + " has tangents of length 0, not finite or without handedness; "
                                 "all of its tangents are derived instead");
            primitive.tangents.clear();
            return;
        }
        tangent = glm::vec4(direction, tangent.w < 0 ? -1.0F : 1.0F);
    }
}

} // namespace froxel::gltf
