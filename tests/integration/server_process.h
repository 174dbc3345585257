// The real binary's server as a child process, on free ports of 127.0.0.1 and the CPU device.
#pragma once

#include "integration/child_process.h"

#include <cstdint>

namespace froxel::test {

class ServerProcess : public ChildProcess {
  public:
    // `froxel serve ARGUMENTS`; `port` 0 is any free one.
    explicit ServerProcess(const std::vector<std::string>& arguments, uint16_t port = 0);

    // From the URL that it prints; none when it ended without printing one.
    [[nodiscard]] std::optional<uint16_t> port();
    // Of /metrics, after port().
    [[nodiscard]] std::optional<uint16_t> adminPort() { return port(); }
};

} // namespace froxel::test
