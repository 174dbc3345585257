#include "net/token_gate.h"

#include "core/text.h"
#include "protocol/limits.h"
#include "session/resume_token.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <utility>

namespace froxel::net {
namespace {

constexpr size_t kMaxTokens = 10'000;

bool isToken(std::string_view text) {
    return text.size() >= TokenGate::kMinTokenBytes && text.size() <= protocol::kMaxTokenBytes &&
           std::all_of(text.begin(), text.end(), [](char c) { return c > 0x20 && c < 0x7F; });
}

} // namespace

Result<void> TokenGate::load(const std::filesystem::path& path) {
    const std::string name = printable(path.string(), 200);
    std::ifstream in(path);
    std::vector<std::string> tokens;
    size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        if (line.empty() || line.front() == '#') {
            continue;
        }
        if (!isToken(line) || tokens.size() == kMaxTokens) {
            return Error{ErrorCode::kInvalidArgument,
                         name + " line " + numberText(number) + ": a token has " +
                             numberText(kMinTokenBytes) + " to " +
                             numberText(protocol::kMaxTokenBytes) +
                             " bytes of printable ASCII without spaces, and a file at most " +
                             numberText(kMaxTokens) + " of them"};
        }
        tokens.push_back(std::move(line));
    }
    if (!in.eof()) {
        return Error{ErrorCode::kIo, name + " cannot be read"};
    }
    if (tokens.empty()) {
        return Error{ErrorCode::kInvalidArgument,
                     name +
                         " has no token: nobody could come in; without --token-file everybody can"};
    }
    // A token that stays is the same object, so that its passes stay valid.
    const std::lock_guard lock(mutex_);
    std::map<std::string_view, Token> before;
    for (const Token& token : tokens_) {
        before.emplace(*token, token);
    }
    std::vector<Token> now;
    for (std::string& token : tokens) {
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
