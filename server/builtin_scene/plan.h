// The hall's plan in metres: x along the nave, y up, z across. Seven bays, two storeys.
#pragma once

#include <cstdint>

namespace froxel::builtin_scene::plan {

inline constexpr uint32_t kBays = 7;
inline constexpr float kBay = 4.5F;
inline constexpr float kHalfLength = 0.5F * kBay * kBays; // inner face of the end walls
inline constexpr float kColumnZ = 4.0F;                   // axis of the colonnades
inline constexpr float kWallZ = 8.0F;                     // inner face of the side walls
inline constexpr float kArcadeHalfDepth = 0.25F;

// Levels.
inline constexpr float kSpring = 3.4F; // lower arches
inline constexpr float kArchRadius = 1.8F;
inline constexpr float kGalleryFloor = 6.0F;
inline constexpr float kUpperSpring = 8.0F; // gallery arches, two a bay
inline constexpr float kUpperRadius = 0.9F;
inline constexpr float kFrieze = 9.2F; // bottom of the mosaic band
inline constexpr float kVaultSpring = 10.0F;
inline constexpr float kVaultHalfSpan = 3.75F;
inline constexpr float kVaultRise = 3.0F;
inline constexpr float kVaultRadius =
    (kVaultHalfSpan * kVaultHalfSpan + kVaultRise * kVaultRise) / (2.0F * kVaultRise);

inline constexpr float kApseRadius = 2.8F;
inline constexpr float kApseSpring = 4.4F;
inline constexpr float kEndWallDepth = 0.5F;

// Middle of a bay, counted from the west.
[[nodiscard]] constexpr float bayX(uint32_t bay) {
    return -kHalfLength + kBay * (static_cast<float>(bay) + 0.5F);
}
// A line of columns; 0 and kBays are the end walls.
[[nodiscard]] constexpr float lineX(uint32_t line) {
    return -kHalfLength + kBay * static_cast<float>(line);
}

} // namespace froxel::builtin_scene::plan
