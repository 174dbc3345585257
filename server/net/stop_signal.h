// SIGTERM and SIGINT as something that the main thread waits for.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

namespace froxel::net {

// Of the calling thread, and of those that it begins: both wait until somebody catches them. Before
// that, the first process of a container would lose them (pid_namespaces(7)).
void holdStopSignals();
// They end the process again, as by default.
void letStopSignalsGo();

class StopSignal {
  public:
    // Catches both from now on, and one that was held. On the thread that held them.
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    // SIGHUP calls this while wait() blocks, instead of ending the process.
    void onHangup(std::function<void()> action);
    // Blocks until a signal or a request, or until `goes_on`, which is asked every period, says no.
    // The signal's number, 0 for anything else. From its return on, a signal ends the process at
    // once, as by default.
    [[nodiscard]] int wait(std::chrono::milliseconds period, const std::function<bool()>& goes_on);
    [[nodiscard]] int wait() {
        return wait(std::chrono::hours(1), [] { return true; });
    }
    // Makes wait() return. Any thread.
    void request();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::net
