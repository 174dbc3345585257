// What a process that reads hostile files gives up before it sees a byte of them.
#pragma once

#include <cstdint>
#include <string>

namespace froxel::bake {

// What the kernel and this build offer, or what a process has given up.
struct Isolation {
    bool landlock = false; // no file can be opened
    bool seccomp = false;  // no system calls but those that reading takes

    [[nodiscard]] bool full() const { return landlock && seccomp; }
};

struct ResourceLimits {
    uint64_t address_bytes = 0; // of memory, code and stacks; 0: no limit
    uint64_t data_bytes = 0;    // of memory that is written to; 0: no limit
    uint64_t output_bytes = 0;  // of what it writes; 0: no limit
    uint32_t cpu_s = 0;         // of all threads together; 0: no limit
};

// What isolate() would give up here.
[[nodiscard]] Isolation isolationHere();

// Of the calling process, for good, before it has threads. Open descriptors stay usable. Gives up
// what it can; a build with a sanitizer, which needs more, gives up nothing.
[[nodiscard]] Isolation isolate(const ResourceLimits& limits);

// "landlock and seccomp", "seccomp alone", ...
[[nodiscard]] std::string wordsOf(const Isolation& isolation);

// After isolate(): tries to open a file, to connect, and to execute. Empty where each failed, else
// a line that says what worked.
[[nodiscard]] std::string escapeOf(const Isolation& isolation);

} // namespace froxel::bake
