// SIGTERM and SIGINT as something that the main thread waits for.
#pragma once

#include <memory>

namespace froxel::net {

class StopSignal {
  public:
    // Catches both from now on.
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    // Blocks until a signal or a request; the signal's number, 0 for a request. From its return
    // on, a signal ends the process at once, as by default.
    [[nodiscard]] int wait();
    // Makes wait() return. Any thread.
    void request();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::net
