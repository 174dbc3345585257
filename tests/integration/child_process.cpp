#include "integration/child_process.h"

#include <gtest/gtest.h>

#include <csignal>
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

ChildProcess::ChildProcess(std::vector<std::string> arguments) {
    error_file_ = testing::TempDir() + "froxel_child_XXXXXX";
    const int errors = mkostemp(error_file_.data(), O_CLOEXEC);
    int out[2] = {-1, -1};
    if (errors < 0 || pipe2(out, O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe or file for the child");
    }
    pid_ = fork();
    if (pid_ == 0) {
        become(std::move(arguments), out[1], errors);
    }
    close(out[1]);
    close(errors);
    stdout_ = out[0];
    if (pid_ < 0) {
        throw std::runtime_error("cannot fork");
    }
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(stdout_);
    std::error_code ignored;
    std::filesystem::remove(error_file_, ignored);
}

std::string ChildProcess::readLine() {
    std::string line;
    char character = 0;
    while (read(stdout_, &character, 1) == 1 && character != '\n') {
        line += character;
    }
    return line;
}

void ChildProcess::signal(int number) const {
    kill(pid_, number);
}

ChildProcess::End ChildProcess::wait(std::chrono::seconds timeout) {
    const int process = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
    pollfd ended{process, POLLIN, 0};
    const auto limit = std::chrono::duration_cast<std::chrono::milliseconds>(timeout);
    const int ready = poll(&ended, 1, static_cast<int>(limit.count()));
    close(process);
    if (ready != 1) {
        throw std::runtime_error("the child runs on");
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
    char part[4096];
    for (ssize_t size = 0; (size = read(stdout_, part, sizeof part)) > 0;) {
        end.output.append(part, static_cast<size_t>(size));
    }
    std::ifstream file(error_file_);
    end.errors.assign(std::istreambuf_iterator<char>(file), {});
    return end;
}

} // namespace froxel::test
