#include "app/log_queue.h"

#include "core/thread_name.h"

#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <mutex>
#include <poll.h>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <utility>

namespace froxel::app {
namespace {

// All of it, however long that takes; false where the descriptor refuses it.
bool writeWhole(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes.remove_prefix(static_cast<size_t>(written));
        } else if (errno == EAGAIN) { // whoever started us may have made it non-blocking
            pollfd room{.fd = descriptor, .events = POLLOUT, .revents = 0};
            ::poll(&room, 1, -1);
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

} // namespace

struct LogQueue::State {
    const int descriptor;
    const size_t lines_max;
    const std::function<std::string(uint64_t)> tell;

    mutable std::mutex mutex;
    std::condition_variable added;
    std::condition_variable emptied;
    std::deque<std::string> lines; // the first is being written
    uint64_t lost = 0;
    uint64_t lost_told = 0;
    bool over = false;

    State(int to, size_t max, std::function<std::string(uint64_t)> told)
        : descriptor(to), lines_max(max), tell(std::move(told)) {}

    void run() {
        std::unique_lock lock(mutex);
        for (;;) {
            added.wait(lock, [this] { return over || !lines.empty(); });
            if (lines.empty()) {
                return;
            }
            const std::string& line = lines.front();
            lock.unlock();
            const bool written = writeWhole(descriptor, line);
            lock.lock();
            lines.pop_front();
            lost += written ? 0 : 1;
            // Behind all that was kept, since it came later.
            if (written && lost > lost_told && lines.size() <= lines_max / 2) {
                lines.push_back(tell(lost - lost_told));
                lost_told = lost;
            }
            if (lines.empty()) {
                emptied.notify_all();
            }
        }
    }
};

LogQueue::LogQueue(int descriptor, size_t lines_max, std::function<std::string(uint64_t)> tell)
    : state_(std::make_shared<State>(descriptor, lines_max, std::move(tell))) {
    // Signals are for the threads that know what to do with them.
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    std::thread([state = state_] {
        nameThread("log");
        state->run();
    }).detach();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

LogQueue::~LogQueue() {
    flush();
    const std::lock_guard lock(state_->mutex);
    state_->over = true;
    state_->added.notify_one();
}

void LogQueue::add(std::string line) {
    const std::lock_guard lock(state_->mutex);
    if (state_->lines.size() >= state_->lines_max) {
        ++state_->lost;
        return;
    }
    state_->lines.push_back(std::move(line));
    state_->added.notify_one();
}

void LogQueue::flush() {
    std::unique_lock lock(state_->mutex);
    state_->emptied.wait_for(lock, kPatience, [this] { return state_->lines.empty(); });
}

uint64_t LogQueue::lost() const {
    const std::lock_guard lock(state_->mutex);
    return state_->lost;
}

} // namespace froxel::app
