#include "bench/progress.h"

#include "core/text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace froxel::bench {

namespace {

size_t terminalColumns() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

std::string timeLeft(double done_share, double elapsed_s) {
    if (done_share <= 0.01) {
        return "time left unknown";
    }
    const double left_s = elapsed_s * (1 - done_share) / done_share;
    return left_s < 90 ? fmt::format("{:.0f} s left", left_s)
                       : fmt::format("{:.0f} min left", left_s / 60);
}

} // namespace

std::string
progressLine(double done_share, double elapsed_s, const std::string& what, size_t columns) {
    constexpr size_t kWidth = 24;
    const double share = std::clamp(done_share, 0.0, 1.0);
    const auto filled = static_cast<size_t>(share * kWidth);
    auto line = fmt::format("[{}{}] {:3.0f} %, {}  {}", std::string(filled, '='),
                            std::string(kWidth - filled, ' '), 100 * share,
                            timeLeft(share, elapsed_s), what);
    line.resize(std::min(line.size(), columns));
    return line;
}

Progress::Progress(double row_count) : shown_(isatty(STDERR_FILENO) != 0), row_count_(row_count) {}

Progress::~Progress() {
    if (shown_) {
        std::fputs("\r\x1b[K", stderr);
    }
}

void Progress::at(const std::string& sweep, const std::string& what) {
    if (!shown_) {
        return;
    }
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const auto line = progressLine(done_ / row_count_, elapsed_s, sweep + ": " + printable(what),
                                   terminalColumns() - 1);
    std::fputs(("\r\x1b[K" + line).c_str(), stderr);
    std::fflush(stderr);
}

void Progress::done(double rows) {
    done_ += rows;
}

} // namespace froxel::bench
