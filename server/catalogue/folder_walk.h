// Goes through a folder and those below it.
#pragma once

#include <filesystem>
#include <functional>
#include <system_error>
#include <vector>

namespace froxel::catalogue {

// What could not be looked at though it may well be there: descriptors are used up, say, or a
// network's file system does not answer.
struct Unread {
    std::filesystem::path path; // of a folder or a file, as it was walked to
    std::error_code why;
};

struct FolderVisitor {
    // Each folder before what is in it, the first one too.
    std::function<void(const std::filesystem::path& folder)> on_folder =
        [](const std::filesystem::path& /*folder*/) {};
    // All in a folder that is no folder. An error: see Unread.
    std::function<std::error_code(const std::filesystem::directory_entry& entry)> on_file =
        [](const std::filesystem::directory_entry& /*entry*/) { return std::error_code(); };
};

// Hidden ones are left out, links to folders not followed, folders more than `deepest` below the
// first not entered. What went meanwhile or is nobody's to read is no trouble. Opens one folder at
// a time.
[[nodiscard]] std::vector<Unread>
walkFolder(const std::filesystem::path& folder, int deepest, const FolderVisitor& visitor);

// Whether such an error says that nothing is there for this process, and will not be by itself.
[[nodiscard]] bool meansAbsent(std::error_code error);

} // namespace froxel::catalogue
