// What a scene file may ask for. A file of a few bytes can name billions of vertices (accessors
// without data, compression, sparse), so the budgets bound what is made, not what is read.
#pragma once

#include "gltf/failure.h"

#include <cstdint>
#include <string>

namespace froxel::gltf {

// A fuzzer would find nothing but these limits: to it whatever takes over 2 GB is a fault.
[[nodiscard]] constexpr uint64_t limitOf(uint64_t amount) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
    return amount / 1024;
#else
    return amount;
#endif
}

inline constexpr uint64_t kMaxJsonBytes = 128ULL << 20U;
inline constexpr int kMaxJsonDepth = 64;
inline constexpr size_t kMaxElements = 1ULL << 20U;                    // nodes, meshes, ...
inline constexpr uint64_t kMaxFileBytes = limitOf(4ULL << 30U);        // all of a scene together
inline constexpr uint64_t kMaxDecodedViewBytes = limitOf(4ULL << 30U); // EXT_meshopt_compression
inline constexpr uint64_t kMaxVertices = limitOf(1ULL << 26U);
inline constexpr uint64_t kMaxIndices = limitOf(3ULL << 26U);
// Of a primitive: beyond, the shader derives its tangents.
inline constexpr uint64_t kMostTangentCorners = limitOf(3ULL << 23U);
inline constexpr uint64_t kMaxInfluences = limitOf(1ULL << 27U);
inline constexpr uint64_t kMaxMorphDeltas = limitOf(1ULL << 25U);
inline constexpr uint64_t kMaxKeyNumbers = limitOf(1ULL << 27U); // of all clips
inline constexpr uint64_t kMaxInstances = limitOf(1ULL << 20U);
inline constexpr uint32_t kMaxImageSide_px = 16384;
inline constexpr uint64_t kMaxDecodedImageBytes = limitOf(4ULL << 30U); // RGBA8 of all images

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
