// Which pictures of two folders belong together.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace froxel::diff {

// One that a name ends like a picture: .png, .jpg, .jpeg, .exr or .pfm, in any case.
[[nodiscard]] bool isPictureName(const std::filesystem::path& path);

struct FolderPairs {
    // Paths below the folders, sorted.
    std::vector<std::filesystem::path> both;
    std::vector<std::filesystem::path> only_picture;
    std::vector<std::filesystem::path> only_reference;
};

inline constexpr size_t kMaxPictures = 100'000;

// Pictures at any depth, by equal paths. Errors: kIo naming the folder, kInvalidArgument where
// neither has a picture, kCapacity for more than kMaxPictures in one.
[[nodiscard]] Result<FolderPairs> pairsOf(const std::filesystem::path& pictures,
                                          const std::filesystem::path& references);

} // namespace froxel::diff
