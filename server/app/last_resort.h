// Ends the process where its orderly end does not come: when a frame on a device, or a driver,
// takes for ever, there is no thread to join.
#pragma once

#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace froxel::app {

class LastResort {
  public:
    // From now on, unless this ends before.
    LastResort(std::chrono::milliseconds patience, int exit_code)
        : thread_([patience, exit_code](const std::stop_token& over) {
              std::mutex mutex;
              std::condition_variable_any wake;
              std::unique_lock lock(mutex);
              wake.wait_for(lock, over, patience, [] { return false; });
              if (!over.stop_requested()) {
                  spdlog::warn("event=exit_forced after_ms={}", patience.count());
                  spdlog::default_logger()->flush(); // other threads may yet log
                  std::quick_exit(exit_code);
              }
          }) {}

  private:
    std::jthread thread_;
};

} // namespace froxel::app
