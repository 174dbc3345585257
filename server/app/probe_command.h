// `froxel probe URL`: asks a server's health, for containers and scripts that have no other client.
#pragma once

#include <string>

namespace froxel::app {

struct ProbeOptions {
    std::string url = "http://127.0.0.1:9090/readyz";
    double timeout_s = 4;
};

// Prints one line, what the server answered. 0 where it is well (a status of 200 to 299), else 1.
// Throws StartupError: kInvalidArgument, kIo where it does not answer.
[[nodiscard]] int runProbe(const ProbeOptions& options);

} // namespace froxel::app
