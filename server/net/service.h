// What every connection of one server shares: how far the server is, and who wants to know when
// that changes. Any thread.
#pragma once

#include "core/heartbeat.h"
#include "core/progress.h"
#include "session/scene_port.h"
#include "session/session_context.h"
#include "session/stream_port.h"

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace froxel::net {

// Scene and stream are there.
struct Serving {
    std::shared_ptr<const session::SessionContext> context;
    session::StreamPort* port = nullptr; // outlives every connection
    // Of the thread that draws; null: not watched.
    std::shared_ptr<const Heartbeat> heartbeat{};
    Seconds step_limit{0};                // one step of it that takes longer never ends
    session::ScenePort* scenes = nullptr; // outlives every connection
    bool offers_depth = true;             // with pictures, to clients that ask for it
};

// No session begins any more; those that are there go on until it is over.
struct Draining {
    std::chrono::milliseconds deadline{0}; // from the start of it to its end
    std::string reconnect_url;             // of another server; empty: the same address
    bool over = false;
};

struct ServiceStatus {
    Progress loading{"starting", 0}; // while `serving` is none
    std::optional<Serving> serving;
    std::optional<Draining> draining;
    std::optional<std::string> lost; // why no picture comes any more, though the process lives
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
    void setLoading(Progress progress);
    void setServing(Serving serving);
    void setDraining(Draining draining);
    void setLost(std::string why);
    // Has everyone look again, as when tokens were taken away.
    void announce();

    void subscribe(std::weak_ptr<ServiceListener> listener);

  private:
    template <class Change>
    void change(const Change& apply);

    mutable std::mutex mutex_;
    ServiceStatus status_;
    std::vector<std::weak_ptr<ServiceListener>> listeners_;
};

} // namespace froxel::net
