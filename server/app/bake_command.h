// `froxel bake`: the process that reads scenes for others, and what it is kept from.
#pragma once

namespace froxel::app {

struct BakeOptions {
    bool reader = false;    // started by another froxel, with its descriptors
    bool self_test = false; // tries to escape
};

// Before any thread has begun: what a process gives up, it gives up thread by thread. The exit
// code.
[[nodiscard]] int runBake(const BakeOptions& options);

} // namespace froxel::app
