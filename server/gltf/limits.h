// What a scene file may ask for. A file of a few bytes can name billions of vertices (accessors
// without data, compression, sparse), so the budgets bound what is made, not what is read. Work
// grows no faster than what they count: whatever is done for each pair of two things of the file
// (the primitives of a mesh for each node that shows it) has a budget of its own.
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
inline constexpr size_t kMaxElements = 1ULL << 20U; // nodes, meshes, ...
inline constexpr size_t kMaxMaterials = 1ULL << 16U;
inline constexpr uint64_t kMaxPrimitives = limitOf(1ULL << 20U);       // that are read
inline constexpr uint64_t kMaxPlacedPrimitives = limitOf(1ULL << 22U); // of all instances
inline constexpr uint64_t kMaxFileBytes = limitOf(4ULL << 30U);        // all of a scene together
inline constexpr uint64_t kMaxDecodedViewBytes = limitOf(4ULL << 30U); // EXT_meshopt_compression
inline constexpr uint64_t kMaxVertices = limitOf(1ULL << 26U);
inline constexpr uint64_t kMaxIndices = limitOf(3ULL << 27U);
// Of a primitive: beyond, the shader derives its tangents.
inline constexpr uint64_t kMostTangentCorners = limitOf(3ULL << 23U);
inline constexpr uint64_t kMaxInfluences = limitOf(1ULL << 27U);
inline constexpr uint64_t kMaxMorphDeltas = limitOf(1ULL << 25U);
inline constexpr uint64_t kMaxMorphWeights = limitOf(1ULL << 20U); // of all nodes together
inline constexpr uint64_t kMaxPosedJoints = limitOf(1ULL << 20U);  // of all meshes with a skin
inline constexpr uint64_t kMaxKeyNumbers = limitOf(1ULL << 27U);   // of all clips
inline constexpr uint64_t kMaxInstances = limitOf(1ULL << 20U);
inline constexpr uint32_t kMaxImageSide_px = 16384;
inline constexpr uint64_t kMaxDecodedImageBytes = limitOf(4ULL << 30U); // RGBA8 of all images

// Of what people choose by name: cameras, animations, material variants. Every viewer is sent all
// of them.
inline constexpr size_t kMaxChoices = 1024; // of each kind
// A command may name 256 bytes: room is left for the number of one of many of the same name.
inline constexpr size_t kMaxNameBytes = 240;

// What compressed bytes hold at most, as their formats have it.
// Four channels of 256 vertices that never change take one byte of control bits.
inline constexpr uint64_t kMeshoptVertexRatio = 1024;
inline constexpr uint64_t kMeshoptTriangleRatio = 12; // a byte for each triangle
inline constexpr uint64_t kMeshoptIndexRatio = 4;     // a byte for each index
// Faces a byte. Entropy coding has no bound of its own: this one keeps work linear in the file.
inline constexpr uint64_t kDracoFacesOfByte = 1ULL << 14U;

// Memory that things take while a scene is read, bytes each.
// In the tree, in its text, and in tinygltf's own tree; of each key, too, and twice of an object.
inline constexpr uint64_t kJsonValueBytes = 128;
inline constexpr uint64_t kElementBytes = 1024;   // of the file's arrays, as tinygltf keeps it
inline constexpr uint64_t kMaterialBytes = 4096;  // there and in the scene
inline constexpr uint64_t kPrimitiveBytes = 1024; // likewise
inline constexpr uint64_t kVertexBytes = 64;
inline constexpr uint64_t kIndexBytes = 8;
inline constexpr uint64_t kInfluenceBytes = 16;
inline constexpr uint64_t kMorphDeltaBytes = 96;
inline constexpr uint64_t kKeyNumberBytes = 8;
inline constexpr uint64_t kInstanceBytes = 512;
inline constexpr uint64_t kPosedJointBytes = 256;

// The memory that one read may take; asked before anything is allocated. Not thread-safe.
class ReadMemory {
  public:
    explicit ReadMemory(uint64_t limit_bytes) : limit_bytes_(limit_bytes) {}

    void take(uint64_t bytes, const std::string& user) {
        if (bytes > limit_bytes_ - used_bytes_) {
            fail(user + " needs " + mib(bytes) + " MiB of memory after " + mib(used_bytes_) +
                 "; there are " + mib(limit_bytes_) + " to read a scene with");
        }
        used_bytes_ += bytes;
    }

  private:
    static std::string mib(uint64_t bytes) {
        return std::to_string((bytes + (1U << 20U) - 1) >> 20U);
    }

    uint64_t limit_bytes_;
    uint64_t used_bytes_ = 0;
};

// Counts one kind of thing down; asked before it is allocated.
class Budget {
  public:
    // Each takes so much of the memory.
    Budget(const char* unit, uint64_t limit, uint64_t bytes_each, ReadMemory& memory)
        : unit_(unit), limit_(limit), bytes_each_(bytes_each), memory_(memory) {}

    void take(uint64_t amount, const std::string& user) {
        if (amount > limit_ - used_) {
            fail(user + " needs " + std::to_string(amount) + " " + unit_ + " after " +
                 std::to_string(used_) + "; a scene may have " + std::to_string(limit_));
        }
        memory_.take(amount * bytes_each_, user);
        used_ += amount;
    }

  private:
    const char* unit_;
    uint64_t limit_;
    uint64_t bytes_each_;
    ReadMemory& memory_;
    uint64_t used_ = 0;
};

} // namespace froxel::gltf
