// The real binary as a child process, on a free port of 127.0.0.1 and the CPU device.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace froxel::test {

class ServerProcess {
  public:
    // `froxel serve ARGUMENTS`; `port` 0 is any free one. Throws std::runtime_error when it cannot
    // be started.
    explicit ServerProcess(const std::vector<std::string>& arguments, uint16_t port = 0);
    // Kills it if it still runs.
    ~ServerProcess();
    ServerProcess(const ServerProcess&) = delete;
    ServerProcess& operator=(const ServerProcess&) = delete;

    // From the URL that it prints; none when it ended without printing one.
    [[nodiscard]] std::optional<uint16_t> port();
    void signal(int number) const;

    struct End {
        std::optional<int> exit_code; // none: ended by `signal`
        int signal = 0;
        std::string errors; // what it wrote to stderr
    };
    // Throws std::runtime_error when it runs on for longer.
    [[nodiscard]] End wait(std::chrono::seconds timeout = std::chrono::seconds(60));

  private:
    pid_t pid_ = -1;
    int stdout_ = -1;
    std::string error_file_;
};

} // namespace froxel::test
