#include "app/log_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace froxel::app {
namespace {

constexpr int kPipe = 4096;

// A pipe of one page.
class Pipe {
  public:
    Pipe() {
        EXPECT_EQ(pipe2(ends_, O_CLOEXEC), 0);
        EXPECT_EQ(fcntl(ends_[1], F_SETPIPE_SZ, kPipe), kPipe);
        // As every command has it (app/standard_streams.h).
        std::signal(SIGPIPE, SIG_IGN);
    }
    ~Pipe() {
        close(ends_[0]);
        close(ends_[1]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    [[nodiscard]] int in() const { return ends_[1]; }
    // Until `text` ends what was read; all that was read.
    [[nodiscard]] std::string readUntil(const std::string& text) const {
        std::string all;
        char part[kPipe];
        while (!all.ends_with(text)) {
            const ssize_t size = read(ends_[0], part, sizeof part);
            all.append(part, static_cast<size_t>(std::max<ssize_t>(size, 0)));
        }
        return all;
    }
    void readerLeaves() {
        close(ends_[0]);
        ends_[0] = -1;
    }

  private:
    int ends_[2] = {-1, -1};
};

std::string tell(uint64_t lost) {
    return "lost " + std::to_string(lost) + "\n";
}

TEST(LogQueue, Lines_InTheirOrderAndWhole) {
    const Pipe pipe;
    LogQueue queue(pipe.in(), 8, tell);
    queue.add("a\n");
    queue.add("b\n");
    EXPECT_EQ(pipe.readUntil("b\n"), "a\nb\n");
    queue.flush();
    EXPECT_EQ(queue.lost(), 0U);
}

TEST(LogQueue, ReaderStandsStill_NobodyWaitsAndWhatIsLostIsTold) {
    const Pipe pipe;
    LogQueue queue(pipe.in(), 4, tell);
    const std::string page(kPipe - 1, '-');
    queue.add(page + "\n"); // fills the pipe
    queue.flush();
    for (int i = 0; i < 10; ++i) {
        queue.add(std::to_string(i) + "\n");
    }
    EXPECT_EQ(queue.lost(), 6U);
    EXPECT_EQ(pipe.readUntil("lost 6\n"), page + "\n0\n1\n2\n3\nlost 6\n");
    queue.add("on\n");
    EXPECT_EQ(pipe.readUntil("on\n"), "on\n");
    EXPECT_EQ(queue.lost(), 6U);
}

TEST(LogQueue, ReaderStandsStillAtTheEnd_EndsAllTheSame) {
    const Pipe pipe;
    LogQueue queue(pipe.in(), 4, tell);
    queue.add(std::string(kPipe, '-'));
    queue.add("never read\n");
}

TEST(LogQueue, ReaderIsGone_LinesAreCountedAsLost) {
    Pipe pipe;
    LogQueue queue(pipe.in(), 4, tell);
    pipe.readerLeaves();
    queue.add("a\n");
    queue.add("b\n");
    queue.flush();
    EXPECT_EQ(queue.lost(), 2U);
}

TEST(LogQueue, DescriptorIsNonBlocking_LinesWaitForRoom) {
    const Pipe pipe;
    ASSERT_EQ(fcntl(pipe.in(), F_SETFL, O_NONBLOCK), 0);
    LogQueue queue(pipe.in(), 4, tell);
    queue.add(std::string(kPipe, '-'));
    queue.add("a\n");
    EXPECT_EQ(pipe.readUntil("a\n").size(), kPipe + 2U);
    EXPECT_EQ(queue.lost(), 0U);
}

} // namespace
} // namespace froxel::app
