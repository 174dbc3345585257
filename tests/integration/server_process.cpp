#include "integration/server_process.h"

#include "support/places.h"

#include <cstdlib>

namespace froxel::test {
namespace {

std::vector<std::string> command(const std::vector<std::string>& arguments, uint16_t port) {
    setenv("FROXEL_UPLOADS", "off", 0); // servers side by side would share one folder
    std::vector<std::string> all = {test::binaryPath(), "serve",
                                    "--device",         "cpu",
                                    "--port",           std::to_string(port),
                                    "--admin-bind",     "127.0.0.1:0",
                                    "--min-fps",        "0",
                                    "--drain-seconds",  "1"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
}

} // namespace

ServerProcess::ServerProcess(const std::vector<std::string>& arguments, uint16_t port)
    : ChildProcess(command(arguments, port)) {}

std::optional<uint16_t> ServerProcess::port() {
    const std::string line = readLine();
    const std::string prefix = "http://127.0.0.1:";
    if (!line.starts_with(prefix)) {
        return {};
    }
    return static_cast<uint16_t>(std::strtoul(line.c_str() + prefix.size(), nullptr, 10));
}

} // namespace froxel::test
