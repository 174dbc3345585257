// The one buffer of a GLB: bytes, the views into them and the accessors over those.
#pragma once

#include "core/math.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::gltf_writer {

using Json = nlohmann::ordered_json;

class BinaryBuffer {
  public:
    // Each returns the index of the accessor made. `with_bounds` adds min and max, as POSITION
    // needs them.
    uint32_t addIndices(std::span<const uint32_t> indices, size_t vertex_count);
    uint32_t addVectors(std::span<const glm::vec2> values);
    uint32_t addVectors(std::span<const glm::vec3> values, bool with_bounds = false);
    uint32_t addVectors(std::span<const glm::vec4> values);

    // Returns the index of a view of its own.
    uint32_t addBytes(std::span<const std::byte> bytes);

    [[nodiscard]] const Json& views() const { return views_; }
    [[nodiscard]] const Json& accessors() const { return accessors_; }
    [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    uint32_t addAccessor(uint32_t view, int component_type, size_t count, const char* type);

    std::vector<std::byte> bytes_; // every view starts at a multiple of 4
    Json views_ = Json::array();
    Json accessors_ = Json::array();
};

} // namespace froxel::gltf_writer
