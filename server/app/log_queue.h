// Lines on their way to a descriptor whose reader may be slow, stand still or be gone. Whoever adds
// a line never waits for the reader: a thread of the queue's own writes, lines beyond the bound are
// lost and counted, and once lines flow again one of them says how many were lost.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace froxel::app {

class LogQueue {
  public:
    // Writes to `descriptor`, which outlives the process's last line; holds at most `lines_max`.
    // `tell` makes the line that says how many were lost.
    LogQueue(int descriptor, size_t lines_max, std::function<std::string(uint64_t)> tell);
    // Waits as flush() does; a thread that is still inside a write is left behind.
    ~LogQueue();
    LogQueue(const LogQueue&) = delete;
    LogQueue& operator=(const LogQueue&) = delete;

    // A line with its end. Any thread; a lock inside is held for a move.
    void add(std::string line);

    // Until all is written, at most kPatience. Any thread.
    static constexpr std::chrono::milliseconds kPatience{1000};
    void flush();

    // Lines that found no room or that the descriptor refused, since the start. Any thread.
    [[nodiscard]] uint64_t lost() const;

  private:
    struct State;
    const std::shared_ptr<State> state_; // the thread's too
};

} // namespace froxel::app
