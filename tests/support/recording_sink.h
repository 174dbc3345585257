// A FrameSink that keeps what it gets and lets a test wait for it.
#pragma once

#include "session/stream_port.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

namespace froxel::test {

class RecordingSink final : public session::FrameSink {
  public:
    struct Refusal {
        Error error;
        session::SessionState refused;
        std::optional<session::SessionState> drawn;
    };
    struct Record {
        std::vector<session::ReadyFrame> frames;
        std::vector<Refusal> refusals;
        std::vector<Error> not_encoded;
        std::vector<bool> compiling;
        std::optional<Error> lost;
    };

    void deliver(session::ReadyFrame frame) override {
        change([&] { record_.frames.push_back(std::move(frame)); });
    }
    void refuse(Error error,
                session::SessionState refused,
                std::optional<session::SessionState> drawn) override {
        change([&] { record_.refusals.push_back({std::move(error), refused, drawn}); });
    }
    void compiling(bool under_way) override {
        change([&] { record_.compiling.push_back(under_way); });
    }
    void notEncoded(Error error) override {
        change([&] { record_.not_encoded.push_back(std::move(error)); });
    }
    void deviceLost(Error error) override {
        change([&] { record_.lost = std::move(error); });
    }

    // Whether `condition(record)` came true within 10 s.
    [[nodiscard]] bool waitFor(const std::function<bool(const Record&)>& condition) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(10),
                                 [&] { return condition(record_); });
    }
    [[nodiscard]] bool waitForFrames(size_t count) {
        return waitFor([&](const Record& record) { return record.frames.size() >= count; });
    }
    [[nodiscard]] std::vector<session::ReadyFrame> frames() { return record().frames; }
    [[nodiscard]] Record record() {
        const std::lock_guard lock(mutex_);
        return record_;
    }

  private:
    template <class Change>
    void change(const Change& apply) {
        const std::lock_guard lock(mutex_);
        apply();
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    Record record_;
};

} // namespace froxel::test
