// Whom a server lets in: everybody, or who knows one of the tokens of a file. Any thread.
#pragma once

#include "core/error.h"
#include "session/account.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::net {

class TokenGate {
    // Numbered as they first came, which is what they are called by.
    struct Token {
        std::string secret;
        uint64_t number = 0;
        bool depth = true; // TokenLine::depth
    };

  public:
    // The file's tokens (token_file.h) take the place of those before. An error changes nothing.
    [[nodiscard]] Result<void> load(const std::filesystem::path& path);

    // Lasts as long as the token is in the file.
    class Pass {
      public:
        [[nodiscard]] bool valid() const { return !token_.expired(); }
        // Whether its viewer may have depth with pictures.
        [[nodiscard]] bool depth() const { return depth_; }
        // None where no token was needed.
        [[nodiscard]] const std::optional<session::Account>& account() const { return account_; }

      private:
        friend class TokenGate;
        std::weak_ptr<const Token> token_;
        std::optional<session::Account> account_;
        bool depth_ = true;
    };
    // For everybody before the first load(), until it. None for a token that is not there. In a
    // time that depends on the lengths alone.
    [[nodiscard]] std::optional<Pass> admit(std::string_view token) const;
    [[nodiscard]] bool lets(std::string_view token) const { return admit(token).has_value(); }

  private:
    mutable std::mutex mutex_;
    // Null from the first load() on.
    std::shared_ptr<const Token> everybody_ = std::make_shared<const Token>();
    std::vector<std::shared_ptr<const Token>> tokens_;
    uint64_t last_number_ = 0;
};

} // namespace froxel::net
