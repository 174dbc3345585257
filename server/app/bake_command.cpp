#include "app/bake_command.h"

#include "bake/isolation.h"
#include "bake/reader.h"

#include <unistd.h>

namespace froxel::app {

int runBake(const BakeOptions& options) {
    if (options.reader) {
        return bake::runReader();
    }
    const bake::Isolation isolation = bake::isolate({});
    const std::string escape = bake::escapeOf(isolation);
    const std::string line = escape.empty()
                                 ? "isolated by " + bake::wordsOf(isolation) +
                                       ": opening a file, connecting and executing all failed"
                                 : "not isolated: " + escape + "; expected landlock and seccomp";
    const std::string text = line + "\n";
    const ssize_t written = write(STDOUT_FILENO, text.data(), text.size()); // all that it may call
    return written >= 0 && escape.empty() ? 0 : 1;
}

} // namespace froxel::app
