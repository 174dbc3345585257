// Whom a server lets in: everybody, or who knows one of the tokens of a file. Any thread.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::net {

class TokenGate {
  public:
    static constexpr size_t kMinTokenBytes = 16; // fewer can be guessed

    // One token a line, of printable ASCII without spaces; blank lines and those that begin with #
    // are left out. Takes the place of the tokens before; sessions that are there go on. An error
    // (kInvalidArgument, kIo) names file and line, never a token, and changes nothing.
    [[nodiscard]] Result<void> load(const std::filesystem::path& path);

    // Everybody before the first load(). In a time that depends on the lengths alone.
    [[nodiscard]] bool lets(std::string_view token) const;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> tokens_;
};

} // namespace froxel::net
