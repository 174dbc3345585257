#include "net/token_file.h"

#include "core/text.h"
#include "protocol/limits.h"

#include <algorithm>
#include <fstream>

namespace froxel::net {
namespace {

constexpr size_t kMaxTokens = 10'000;
constexpr size_t kMinTokenBytes = 16; // fewer can be guessed
constexpr std::string_view kNoDepth = " no-depth";

bool isToken(std::string_view text) {
    return text.size() >= kMinTokenBytes && text.size() <= protocol::kMaxTokenBytes &&
           std::all_of(text.begin(), text.end(), [](char c) { return c > 0x20 && c < 0x7F; });
}

} // namespace

Result<std::vector<TokenLine>> readTokenFile(const std::filesystem::path& path) {
    const std::string name = printable(path.string(), 200);
    std::ifstream in(path);
    std::vector<TokenLine> tokens;
    size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        if (line.empty() || line.front() == '#') {
            continue;
        }
        const bool depth = !line.ends_with(kNoDepth);
        if (!depth) {
            line.resize(line.size() - kNoDepth.size());
        }
        if (!isToken(line) || tokens.size() == kMaxTokens) {
            return Error{ErrorCode::kInvalidArgument,
                         name + " line " + numberText(number) + ": a token has " +
                             numberText(kMinTokenBytes) + " to " +
                             numberText(protocol::kMaxTokenBytes) +
                             " bytes of printable ASCII without spaces, \"" +
                             std::string(kNoDepth) + "\" may follow it, and a file has at most " +
                             numberText(kMaxTokens) + " of them"};
        }
        tokens.push_back({line, depth});
    }
    if (!in.eof()) {
        return Error{ErrorCode::kIo, name + " cannot be read"};
    }
    if (tokens.empty()) {
        return Error{ErrorCode::kInvalidArgument,
                     name + " contains no token, so nobody could connect"};
    }
    return tokens;
}

} // namespace froxel::net
