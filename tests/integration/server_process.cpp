#include "integration/server_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <poll.h>
#include <stdexcept>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace froxel::test {
namespace {

[[noreturn]] void become(std::vector<std::string> arguments, int out, int err) {
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) {
        pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    _exit(127);
}

} // namespace

ServerProcess::ServerProcess(const std::vector<std::string>& arguments, uint16_t port) {
    std::vector<std::string> all = {FROXEL_BINARY, "serve",  "--device",
                                    "cpu",         "--port", std::to_string(port)};
    all.insert(all.end(), arguments.begin(), arguments.end());
    error_file_ = testing::TempDir() + "froxel_serve_XXXXXX";
    const int errors = mkostemp(error_file_.data(), O_CLOEXEC);
    int out[2] = {-1, -1};
    if (errors < 0 || pipe2(out, O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe or file for the child");
    }
    pid_ = fork();
    if (pid_ == 0) {
        become(std::move(all), out[1], errors);
    }
    close(out[1]);
    close(errors);
    stdout_ = out[0];
    if (pid_ < 0) {
        throw std::runtime_error("cannot fork");
    }
}

ServerProcess::~ServerProcess() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(stdout_);
    std::error_code ignored;
    std::filesystem::remove(error_file_, ignored);
}

std::optional<uint16_t> ServerProcess::port() {
    std::string line;
    char character = 0;
    while (read(stdout_, &character, 1) == 1 && character != '\n') {
        line += character;
    }
    const std::string prefix = "http://127.0.0.1:";
    if (!line.starts_with(prefix)) {
        return {};
    }
    return static_cast<uint16_t>(std::strtoul(line.c_str() + prefix.size(), nullptr, 10));
}

void ServerProcess::signal(int number) const {
    kill(pid_, number);
}

ServerProcess::End ServerProcess::wait(std::chrono::seconds timeout) {
    const int process = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
    pollfd ended{process, POLLIN, 0};
    const auto limit = std::chrono::duration_cast<std::chrono::milliseconds>(timeout);
    const int ready = poll(&ended, 1, static_cast<int>(limit.count()));
    close(process);
    if (ready != 1) {
        throw std::runtime_error("the server runs on");
    }
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    End end;
    if (WIFEXITED(status)) {
        end.exit_code = WEXITSTATUS(status);
    } else {
        end.signal = WTERMSIG(status);
    }
    std::ifstream file(error_file_);
    end.errors.assign(std::istreambuf_iterator<char>(file), {});
    return end;
}

} // namespace froxel::test
