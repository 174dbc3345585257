// Tells Agones' SDK, a REST interface on this host, how this server is: ready, healthy, in use,
// how many sessions it has, and that it ends (AgonesPlan has the rules). On a thread of its own:
// whatever the SDK does or leaves undone, nothing here waits for it.
#pragma once

#include "net/service.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace froxel::net {

struct AgonesOptions {
    static constexpr uint16_t kDefaultPort = 9358;

    uint16_t port = kDefaultPort; // of 127.0.0.1 or ::1
    uint32_t sessions_max = 0;    // the counter's capacity
};

// What it asks, on its own thread.
struct AgonesHooks {
    std::function<ServiceStatus()> status;
    std::function<bool()> live; // may wait for a second
    std::function<size_t()> session_count;
};

class Agones {
  public:
    Agones(const AgonesOptions& options, AgonesHooks hooks);
    // Ends without a word.
    ~Agones();
    Agones(const Agones&) = delete;
    Agones& operator=(const Agones&) = delete;

    // Says that nobody is served any more; blocks until that is accepted, at most 2 s. Once.
    void shutDown();

  private:
    struct Impl;
    const std::unique_ptr<Impl> impl_;
};

} // namespace froxel::net
