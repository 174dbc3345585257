// The built page, read once into memory. Requests are answered from this map alone, so no path
// from a URL ever reaches the file system. Immutable after loading; any thread reads.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::net {

// The bytes of a file, or of the same file as a content coding (RFC 9110 section 8.4.1) has it.
struct Representation {
    std::string body;
    std::string etag;        // quoted, as in the header
    std::string_view coding; // empty: as it is
};

struct StaticFile {
    Representation plain;
    std::vector<Representation> coded; // that the build has put beside it, best first
    std::string_view content_type;
    bool immutable = false; // its name holds a hash of its content

    // The first that the field Accept-Encoding (section 12.5.3) allows; `plain` where it is empty.
    [[nodiscard]] const Representation& bestFor(std::string_view accept_encoding) const;
};

class StaticFiles {
  public:
    static constexpr size_t kMaxBytes = size_t{64} * 1024 * 1024; // all files together

    StaticFiles() = default; // no page
    // Regular files below `root`, links left out. A file NAME.br or NAME.gz beside NAME is how that
    // is sent to who understands it, and none by itself. Errors: kIo naming the path: no folder, no
    // index.html, unreadable, more than kMaxBytes.
    [[nodiscard]] static Result<StaticFiles> load(const std::filesystem::path& root);

    // By the exact path of a URL, "/" being index.html; null when there is none.
    [[nodiscard]] const StaticFile* find(std::string_view path) const;
    [[nodiscard]] size_t count() const { return files_.size(); }

  private:
    void gatherCoded();

    std::map<std::string, StaticFile, std::less<>> files_;
};

} // namespace froxel::net
