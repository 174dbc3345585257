#include "net/token_gate.h"

#include "core/text.h"
#include "protocol/limits.h"
#include "session/resume_token.h"

#include <algorithm>
#include <fstream>
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
    const std::lock_guard lock(mutex_);
    tokens_ = std::move(tokens);
    return {};
}

bool TokenGate::lets(std::string_view token) const {
    const std::lock_guard lock(mutex_);
    bool known = tokens_.empty();
    for (const std::string& valid : tokens_) {
        known = session::sameToken(valid, token) || known;
    }
    return known;
}

} // namespace froxel::net
