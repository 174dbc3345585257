// A file of bearer tokens.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace froxel::net {

// At least one. One a line, of printable ASCII without spaces; blank lines and those that begin
// with # are left out. Errors (kInvalidArgument, kIo) name file and line, never a token.
[[nodiscard]] Result<std::vector<std::string>> readTokenFile(const std::filesystem::path& path);

} // namespace froxel::net
