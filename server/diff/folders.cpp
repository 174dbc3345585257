#include "diff/folders.h"

#include "core/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string_view>
#include <system_error>

namespace froxel::diff {

namespace fs = std::filesystem;

namespace {

// Sorted paths below the folder.
Result<std::vector<fs::path>> picturesIn(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code failure;
    fs::recursive_directory_iterator at(folder, failure);
    for (; !failure && at != fs::recursive_directory_iterator(); at.increment(failure)) {
        std::error_code unknown;
        if (isPictureName(at->path()) && at->is_regular_file(unknown)) {
            found.push_back(at->path().lexically_relative(folder));
        }
        if (found.size() > kMaxPictures) {
            return Error{ErrorCode::kCapacity, "'" + printable(folder.string(), 400) +
                                                   "' has more than " + numberText(kMaxPictures) +
                                                   " pictures"};
        }
    }
    if (failure) {
        return Error{ErrorCode::kIo, "cannot read the folder '" + printable(folder.string(), 400) +
                                         "': " + failure.message()};
    }
    std::ranges::sort(found);
    return found;
}

} // namespace

bool isPictureName(const fs::path& path) {
    static constexpr std::array kExtensions = {std::string_view(".png"), std::string_view(".jpg"),
                                               std::string_view(".jpeg"), std::string_view(".exr"),
                                               std::string_view(".pfm")};
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

Result<FolderPairs> pairsOf(const fs::path& pictures, const fs::path& references) {
    const auto a = picturesIn(pictures);
    if (!a) {
        return a.error();
    }
    const auto b = picturesIn(references);
    if (!b) {
        return b.error();
    }
    if (a->empty() && b->empty()) {
        return Error{ErrorCode::kInvalidArgument,
                     "'" + printable(pictures.string(), 400) + "' and '" +
                         printable(references.string(), 400) +
                         "' have no pictures; expected .png, .jpg, .exr or .pfm files"};
    }
    FolderPairs pairs;
    std::ranges::set_intersection(*a, *b, std::back_inserter(pairs.both));
    std::ranges::set_difference(*a, *b, std::back_inserter(pairs.only_picture));
    std::ranges::set_difference(*b, *a, std::back_inserter(pairs.only_reference));
    return pairs;
}

} // namespace froxel::diff
