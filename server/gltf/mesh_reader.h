// Meshes: each read once, when the first node that places it is met.
#pragma once

#include "gltf/accessor_reader.h"
#include "gltf/buffer_views.h"
#include "gltf/document.h"
#include "gltf/limits.h"
#include "gltf/material_reader.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace froxel::gltf {

class DracoMesh;
class VertexSource;

// Not thread-safe. Appends to `scene.meshes`. Throws Failure, naming mesh and primitive.
class MeshReader {
  public:
    MeshReader(const Document& document,
               BufferViews& views,
               AccessorReader& accessors,
               MaterialReader& materials,
               scene::Scene& scene,
               Warnings& warnings);

    // The scene's index of a mesh of the file; kNone where nothing of it can be drawn.
    [[nodiscard]] uint32_t mesh(int index, const std::string& user);

    // One warning for all points and lines of the meshes that were read.
    void tellUndrawn();

  private:
    [[nodiscard]] scene::Mesh read(size_t index);
    [[nodiscard]] std::optional<scene::Primitive> readPrimitive(size_t mesh, size_t number);
    [[nodiscard]] std::vector<uint32_t> readIndices(const tinygltf::Primitive& source,
                                                    int accessor,
                                                    const DracoMesh* draco,
                                                    size_t vertex_count,
                                                    const std::string& user);
    void readStreams(VertexSource& source, scene::Primitive& primitive, const std::string& user);
    void applyMorphs(const tinygltf::Primitive& source,
                     const std::vector<double>& weights,
                     scene::Primitive& primitive,
                     const std::string& user);
    void finishNormals(bool has_normals,
                       scene::Primitive& primitive,
                       const std::string& pointer,
                       const std::string& user);
    void finishTangents(scene::Primitive& primitive,
                        const std::string& pointer,
                        const std::string& user);

    const Document& document_;
    BufferViews& views_;
    AccessorReader& accessors_;
    MaterialReader& materials_;
    scene::Scene& scene_;
    Warnings& warnings_;
    std::map<int, uint32_t> known_;
    size_t undrawn_count_ = 0;
    std::string first_undrawn_; // JSON pointer
    Budget vertices_{"vertices", kMaxVertices};
    Budget indices_{"indices", kMaxIndices};
    Budget morphed_vertices_{"vertices of morph targets", kMaxVertices};
};

} // namespace froxel::gltf
