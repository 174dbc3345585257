// A program as a child process: its standard output line by line, its errors at the end.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace froxel::test {

class ChildProcess {
  public:
    // Throws std::runtime_error when it cannot be started.
    explicit ChildProcess(std::vector<std::string> arguments);
    // Kills it if it still runs.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // Of its standard output, without the line's end; blocks. Empty at the output's end.
    [[nodiscard]] std::string readLine();
    void signal(int number) const;
    [[nodiscard]] pid_t pid() const { return pid_; }

    struct End {
        std::optional<int> exit_code; // none: ended by `signal`
        int signal = 0;
        std::string output{}; // of stdout, what was not read before
        std::string errors{}; // of stderr
    };
    // Throws std::runtime_error when it runs on for longer. What it writes must fit into a pipe.
    [[nodiscard]] End wait(std::chrono::seconds timeout = std::chrono::seconds(60));

  private:
    pid_t pid_ = -1;
    int stdout_ = -1;
    std::string error_file_;
};

} // namespace froxel::test
