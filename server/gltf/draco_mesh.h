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

// What the stream must agree with: the accessors of the primitive.
struct DracoExpectation {
    uint64_t vertex_count = 0;
    uint64_t index_count = 0;
    std::map<std::string, int> attributes; // semantic to the stream's unique attribute id
};

class DracoMesh {
  public:
    // Decodes. Counts are read from the stream's header and compared first, since the decoder
    // allocates by them. Throws Failure, naming `user`.
    DracoMesh(std::span<const std::byte> stream,
              DracoExpectation expected,
              const std::string& user);
    ~DracoMesh();
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    [[nodiscard]] bool has(const std::string& semantic) const {
        return expected_.attributes.contains(semantic);
    }
    [[nodiscard]] std::vector<uint32_t> indices() const;

    // One element per vertex, finite or not. A wrong number of components throws Failure.
    template <int N>
    [[nodiscard]] std::vector<glm::vec<N, float>>
    vectors(const std::string& semantic, bool normalized, const std::string& user) const;

  private:
    DracoExpectation expected_;
    std::unique_ptr<draco::Mesh> mesh_;
};

} // namespace froxel::gltf
