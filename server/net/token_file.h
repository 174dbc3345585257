// A file of bearer tokens.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace froxel::net {

struct TokenLine {
    std::string token;
    bool depth = true; // its viewers may have depth with pictures
};

// At least one. One a line, of printable ASCII without spaces, and maybe " no-depth" behind it;
// blank lines and those that begin with # are left out. Errors (kInvalidArgument, kIo) name file
// and line, never a token.
[[nodiscard]] Result<std::vector<TokenLine>> readTokenFile(const std::filesystem::path& path);

} // namespace froxel::net
