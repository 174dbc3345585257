#include "net/token_gate.h"

#include "core/text.h"
#include "core/unguessable.h"
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
    // A token that stays as it is is the same object, so that its passes stay valid.
    const std::lock_guard lock(mutex_);
    std::map<std::string_view, std::shared_ptr<const Token>> before;
    for (const auto& token : tokens_) {
        before.emplace(token->secret, token);
    }
    std::vector<std::shared_ptr<const Token>> now;
    for (TokenLine& line : *read) {
        const auto found = before.find(line.token);
        const bool same = found != before.end() && found->second->depth == line.depth;
        now.push_back(same ? found->second
                           : std::make_shared<const Token>(
                                 Token{std::move(line.token), ++last_number_, line.depth}));
    }
    tokens_ = std::move(now);
    everybody_.reset();
    return {};
}

std::optional<TokenGate::Pass> TokenGate::admit(std::string_view token) const {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const Token> known = everybody_;
    for (const auto& valid : tokens_) {
        if (sameSecret(valid->secret, token)) {
            known = valid;
        }
    }
    if (!known) {
        return {};
    }
    Pass pass;
    pass.token_ = known;
    pass.depth_ = known->depth;
    if (known != everybody_) {
        pass.account_ = session::Account{"token " + numberText(known->number)};
    }
    return pass;
}

} // namespace froxel::net
