// KHR_draco_mesh_compression: one primitive's triangles and attributes in a Draco stream.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace draco {
class Mesh;
} // namespace draco

namespace froxel::gltf {

// What a stream's header says it decodes to.
struct DracoCounts {
    uint64_t vertices = 0; // or more: Edgebreaker counts them before seams split them
    uint64_t triangles = 0;
};

// The decoder allocates by them: take their memory first. Throws Failure, naming `user`, also where
// so few bytes cannot hold so much.
[[nodiscard]] DracoCounts readDracoCounts(std::span<const std::byte> stream,
                                          const std::string& user);

class DracoMesh {
  public:
    // `attributes`: of a semantic the stream's unique attribute id. Throws Failure, naming `user`.
    DracoMesh(std::span<const std::byte> stream,
              std::map<std::string, int> attributes,
              const std::string& user);
    ~DracoMesh();
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    [[nodiscard]] bool has(const std::string& semantic) const {
        return attributes_.contains(semantic);
    }
    [[nodiscard]] uint64_t vertexCount() const;
    [[nodiscard]] uint64_t triangleCount() const;
    [[nodiscard]] std::vector<uint32_t> indices() const;

    // One element per vertex, finite or not. A wrong number of components throws Failure.
    template <int N>
    [[nodiscard]] std::vector<glm::vec<N, float>>
    vectors(const std::string& semantic, bool normalized, const std::string& user) const;

  private:
    std::map<std::string, int> attributes_;
    std::unique_ptr<draco::Mesh> mesh_;
};

} // namespace froxel::gltf
