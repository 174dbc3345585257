// The built page, read once into memory. Requests are answered from this map alone, so no path
// from a URL ever reaches the file system. Immutable after loading; any thread reads.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace froxel::net {

struct StaticFile {
    std::string body;
    std::string_view content_type;
    std::string etag;       // quoted, as in the header
    bool immutable = false; // its name holds a hash of its content
};

class StaticFiles {
  public:
    static constexpr size_t kMaxBytes = size_t{64} * 1024 * 1024; // all files together

    StaticFiles() = default; // no page
    // Regular files below `root`, links left out. Errors: kIo naming the path: no folder, no
    // index.html, unreadable, more than kMaxBytes.
    [[nodiscard]] static Result<StaticFiles> load(const std::filesystem::path& root);

    // By the exact path of a URL, "/" being index.html; null when there is none.
    [[nodiscard]] const StaticFile* find(std::string_view path) const;
    [[nodiscard]] size_t count() const { return files_.size(); }

  private:
    std::map<std::string, StaticFile, std::less<>> files_;
};

} // namespace froxel::net
