// What a scene file may ask for. A file of a few bytes can name billions of vertices (accessors
// without data, compression, sparse), so the budgets bound what is made, not what is read.
#pragma once

#include "gltf/failure.h"

#include <cstdint>
#include <string>

namespace froxel::gltf {

inline constexpr uint64_t kMaxJsonBytes = 128ULL << 20U;
inline constexpr int kMaxJsonDepth = 64;
inline constexpr size_t kMaxElements = 1ULL << 20U;           // nodes, meshes, accessors, ...
inline constexpr uint64_t kMaxFileBytes = 4ULL << 30U;        // all files of a scene together
inline constexpr uint64_t kMaxDecodedViewBytes = 4ULL << 30U; // EXT_meshopt_compression
inline constexpr uint64_t kMaxVertices = 1ULL << 26U;
inline constexpr uint64_t kMaxIndices = 3ULL << 26U;
inline constexpr uint64_t kMaxInstances = 1ULL << 20U;
inline constexpr uint32_t kMaxImageSide_px = 16384;
inline constexpr uint64_t kMaxDecodedImageBytes = 4ULL << 30U; // RGBA8 of all images together

// Counts one kind of thing down; asked before it is allocated.
class Budget {
  public:
    Budget(const char* unit, uint64_t limit) : unit_(unit), limit_(limit) {}

    void take(uint64_t amount, const std::string& user) {
        if (amount > limit_ - used_) {
            fail(user + " needs " + std::to_string(amount) + " " + unit_ + " after " +
                 std::to_string(used_) + "; a scene may have " + std::to_string(limit_));
        }
        used_ += amount;
    }

  private:
    const char* unit_;
    uint64_t limit_;
    uint64_t used_ = 0;
};

} // namespace froxel::gltf
