#include "catalogue/folder_walk.h"

namespace froxel::catalogue {
namespace {

namespace fs = std::filesystem;

struct Walk {
    const int deepest;
    const FolderVisitor& visitor;
    std::vector<Unread> unread;

    void into(const fs::path& folder, int depth) {
        visitor.on_folder(folder);
        std::vector<fs::path> below;
        std::error_code failed;
        auto entry = fs::directory_iterator(folder, failed);
        for (; !failed && entry != fs::directory_iterator(); entry.increment(failed)) {
            if (entry->path().filename().string().starts_with('.')) {
                continue;
            }
            std::error_code unknown;
            if (!entry->is_symlink(unknown) && entry->is_directory(unknown)) {
                below.push_back(entry->path());
            } else if (const std::error_code why = visitor.on_file(*entry);
                       why && !meansAbsent(why)) {
                unread.push_back({entry->path(), why});
            }
        }
        if (failed && !meansAbsent(failed)) {
            unread.push_back({folder, failed});
        }
        for (const fs::path& one : below) {
            if (depth < deepest) {
                into(one, depth + 1);
            }
        }
    }
};

} // namespace

std::vector<Unread> walkFolder(const fs::path& folder, int deepest, const FolderVisitor& visitor) {
    Walk walk{deepest, visitor, {}};
    walk.into(folder, 0);
    return std::move(walk.unread);
}

bool meansAbsent(std::error_code error) {
    return error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory ||
           error == std::errc::permission_denied ||
           error == std::errc::too_many_symbolic_link_levels;
}

} // namespace froxel::catalogue
