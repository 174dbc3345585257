// A file of tokens, as --token-file reads it: who has a line of it is let in, nobody else.
#include "core/assert.h"
#include "fuzz/memory_file.h"
#include "fuzz/target.h"
#include "net/token_gate.h"

#include <algorithm>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace froxel;
    static const fuzz::MemoryFile file;
    std::string_view text = fuzz::textOf(data, size);
    file.write(text);
    net::TokenGate gate;
    if (const auto loaded = gate.load(file.path()); !loaded) {
        const std::string& message = loaded.error().message;
        FROXEL_ASSERT(fuzz::isOneLine(message) && message.starts_with(file.path()),
                      "a refusal is one line that begins with the file");
        return 0;
    }
    FROXEL_ASSERT(!gate.lets("") && !gate.lets("no token of that file"), "who has none is let in");
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (!line.empty() && line.front() != '#' && line != "\r") {
            const std::string_view token = line.substr(0, line.size() - (line.back() == '\r'));
            FROXEL_ASSERT(gate.lets(token), "who has a token is sent away");
            FROXEL_ASSERT(!gate.lets(std::string(token) + ' '), "more than a token is none");
        }
    }
    return 0;
}
