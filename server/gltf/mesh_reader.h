// Meshes: each read once, when the first node that places it is met.
#pragma once

#include "gltf/accessor_reader.h"
#include "gltf/buffer_views.h"
#include "gltf/deformation_reader.h"
#include "gltf/document.h"
#include "gltf/draco_mesh.h"
#include "gltf/limits.h"
#include "gltf/material_reader.h"
#include "scene/motion.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace froxel::gltf {

class DracoMesh;
class VertexSource;

// How a mesh that deforms does.
struct MeshMotion {
    bool morphs = false;               // its targets are kept; else `weights` are applied for good
    std::optional<size_t> joint_count; // of its skin
};

// Not thread-safe. Appends to `scene.meshes`. Throws Failure, naming mesh and primitive.
class MeshReader {
  public:
    MeshReader(const Document& document,
               BufferViews& views,
               AccessorReader& accessors,
               MaterialReader& materials,
               scene::Scene& scene,
               ReadMemory& memory,
               Warnings& warnings);

    // The scene's index of a mesh of the file with its morph targets at `weights`; kNone where
    // nothing of it can be drawn.
    [[nodiscard]] uint32_t
    mesh(int index, const std::vector<double>& weights, const std::string& user);
    // The same of a mesh that deforms, which is nobody else's. `out`: of each of its primitives.
    [[nodiscard]] uint32_t deformingMesh(int index,
                                         const std::vector<double>& weights,
                                         const MeshMotion& motion,
                                         std::vector<scene::Deformation>& out,
                                         const std::string& user);
    // Of any of the mesh's primitives.
    [[nodiscard]] size_t targetCount(int index, const std::string& user);

    // One warning for all points and lines of the meshes that were read.
    void tellUndrawn();

  private:
    // What a mesh is read with.
    struct Use {
        const std::vector<double>& weights;
        MeshMotion motion;
        std::vector<scene::Deformation>* deformations = nullptr;
    };
    [[nodiscard]] uint32_t add(size_t index, const Use& use);
    [[nodiscard]] std::optional<scene::Primitive>
    readPrimitive(size_t mesh, size_t number, const Use& use);
    // Moves or keeps the targets, reads what moves the vertices.
    void readMotion(const tinygltf::Primitive& source,
                    VertexSource& stream,
                    const Use& use,
                    scene::Primitive& primitive,
                    const std::string& pointer,
                    const std::string& user);
    // Null where the primitive is not compressed.
    [[nodiscard]] std::unique_ptr<DracoMesh> openDraco(const tinygltf::Primitive& source,
                                                       uint64_t& vertex_count,
                                                       uint64_t& index_count,
                                                       const std::string& pointer,
                                                       const std::string& user);
    [[nodiscard]] std::vector<uint32_t> readIndices(const tinygltf::Primitive& source,
                                                    int accessor,
                                                    const DracoMesh* draco,
                                                    size_t vertex_count,
                                                    const std::string& user);
    // What a primitive can do without: if read() throws a Failure, it is left out with a warning.
    void readStream(VertexSource& source,
                    const std::string& semantic,
                    const std::string& pointer,
                    const std::function<void()>& read);
    // Normals, tangents, colours.
    void readStreams(VertexSource& source,
                     scene::Primitive& primitive,
                     const std::string& pointer,
                     const std::string& user);
    // Into uv0 and uv1 the two sets that its materials read.
    [[nodiscard]] TexcoordPlaces readTexcoords(const std::vector<uint32_t>& sets,
                                               VertexSource& source,
                                               scene::Primitive& primitive,
                                               const std::string& pointer,
                                               const std::string& user);
    // Of the primitive and of its variants, and their texture coordinates.
    void readMaterials(const tinygltf::Primitive& source,
                       VertexSource& stream,
                       scene::Primitive& primitive,
                       const std::string& pointer,
                       const std::string& user);
    void finishNormals(bool has_normals,
                       scene::Primitive& primitive,
                       const std::string& pointer,
                       const std::string& user);
    // Where the file has none and its materials ask for them.
    void makeTangents(const Use& use, scene::Primitive& primitive, const std::string& user);
    void finishTangents(scene::Primitive& primitive,
                        const std::string& pointer,
                        const std::string& user);

    const Document& document_;
    BufferViews& views_;
    AccessorReader& accessors_;
    MaterialReader& materials_;
    scene::Scene& scene_;
    Warnings& warnings_;
    std::map<std::pair<int, std::vector<double>>, uint32_t> known_;
    std::set<std::pair<size_t, size_t>> undrawn_;      // points and lines: mesh, primitive
    std::vector<std::optional<size_t>> target_counts_; // of each mesh of the file
    Budget primitives_;
    Budget vertices_;
    Budget indices_;
    DeformationReader deformations_;
};

} // namespace froxel::gltf
