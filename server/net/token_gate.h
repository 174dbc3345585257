// Whom a server lets in: everybody, or who knows one of the tokens of a file. Any thread.
#pragma once

#include "core/error.h"

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::net {

class TokenGate {
  public:
    // The file's tokens (token_file.h) take the place of those before. An error changes nothing.
    [[nodiscard]] Result<void> load(const std::filesystem::path& path);

    // Lasts as long as the token is in the file.
    class Pass {
      public:
        [[nodiscard]] bool valid() const { return !token_.expired(); }

      private:
        friend class TokenGate;
        explicit Pass(std::weak_ptr<const std::string> token) : token_(std::move(token)) {}
        std::weak_ptr<const std::string> token_;
    };
    // For everybody before the first load(), until it. None for a token that is not there. In a
    // time that depends on the lengths alone.
    [[nodiscard]] std::optional<Pass> admit(std::string_view token) const;
    [[nodiscard]] bool lets(std::string_view token) const { return admit(token).has_value(); }

  private:
    using Token = std::shared_ptr<const std::string>;

    mutable std::mutex mutex_;
    Token everybody_ = std::make_shared<const std::string>(); // null from the first load() on
    std::vector<Token> tokens_;
};

} // namespace froxel::net
