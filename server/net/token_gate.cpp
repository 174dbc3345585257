#include "net/token_gate.h"

#include "net/token_file.h"
#include "session/resume_token.h"

#include <map>
#include <utility>

namespace froxel::net {

Result<void> TokenGate::load(const std::filesystem::path& path) {
    auto read = readTokenFile(path);
    if (!read) {
        return read.error();
    }
    // A token that stays is the same object, so that its passes stay valid.
    const std::lock_guard lock(mutex_);
    std::map<std::string_view, Token> before;
    for (const Token& token : tokens_) {
        before.emplace(*token, token);
    }
    std::vector<Token> now;
    for (std::string& token : *read) {
        const auto found = before.find(token);
        now.push_back(found != before.end()
                          ? found->second
                          : std::make_shared<const std::string>(std::move(token)));
    }
    tokens_ = std::move(now);
    everybody_.reset();
    return {};
}

std::optional<TokenGate::Pass> TokenGate::admit(std::string_view token) const {
    const std::lock_guard lock(mutex_);
    Token known = everybody_;
    for (const Token& valid : tokens_) {
        if (session::sameToken(*valid, token)) {
            known = valid;
        }
    }
    return known ? std::optional(Pass(known)) : std::nullopt;
}

} // namespace froxel::net
