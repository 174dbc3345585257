// What every connection of one server shares: how far the server is, and who wants to know when
// that changes. Any thread.
#pragma once

#include "session/session_context.h"
#include "session/stream_port.h"

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace froxel::net {

struct LoadingProgress {
    std::string stage = "starting"; // for a person
    double fraction = 0;            // 0..1
};

// Scene and stream are there.
struct Serving {
    std::shared_ptr<const session::SessionContext> context;
    session::StreamPort* port = nullptr; // outlives every connection
};

struct ServiceStatus {
    LoadingProgress loading; // while `serving` is none
    std::optional<Serving> serving;
    std::optional<std::chrono::milliseconds> draining; // what is left until the end
};

class ServiceListener {
  public:
    virtual ~ServiceListener() = default;
    // On any thread; must not block.
    virtual void onServiceChanged() = 0;
};

class Service {
  public:
    [[nodiscard]] ServiceStatus status() const;
    void setLoading(LoadingProgress progress);
    void setServing(Serving serving);
    void setDraining(std::chrono::milliseconds deadline);

    void subscribe(std::weak_ptr<ServiceListener> listener);

  private:
    template <class Change>
    void change(const Change& apply);

    mutable std::mutex mutex_;
    ServiceStatus status_;
    std::vector<std::weak_ptr<ServiceListener>> listeners_;
};

} // namespace froxel::net
