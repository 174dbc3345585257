// What connections tell the render thread, between two of its frames. Bounded: one slot a session,
// in which a newer state or credit replaces an older one. States are whole values that commands
// were reduced into before, so nothing is lost when one is replaced.
#pragma once

#include "session/stream_port.h"

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

namespace froxel::stream {

// What is new about one session.
struct ViewerNews {
    session::SessionId id = 0;
    std::weak_ptr<session::FrameSink> sink;     // in the first news alone
    std::optional<session::Account> account;    // likewise; none: beside the sessions
    std::optional<session::SessionState> state; // none: as before
    TimePoint arrived{};                        // of the command behind `state`
    uint64_t granted = 0;                       // as StreamPort::grant
    session::Delivery delivery;                 // as StreamPort::setDelivery
    bool left = false;
};

class ViewerMailbox {
  public:
    // Any thread; as StreamPort.
    [[nodiscard]] Result<session::SessionId> join(std::weak_ptr<session::FrameSink> sink,
                                                  const session::SessionState& state,
                                                  std::optional<session::Account> account,
                                                  TimePoint now);
    // Whether join() would succeed now; its errors.
    [[nodiscard]] Result<void> check() const;
    void update(session::SessionId id, const session::SessionState& state, TimePoint arrived);
    void grant(session::SessionId id, uint64_t frame_total);
    void setDelivery(session::SessionId id, const session::Delivery& delivery);
    void leave(session::SessionId id);
    // A picture of its has left. There may be none any more.
    void noteProgress(session::SessionId id);
    // Makes wait() return.
    void wake();
    // join() gives this error from now on.
    void close(Error reason);

    // Render thread.
    [[nodiscard]] std::vector<ViewerNews> take();
    [[nodiscard]] bool hasNews() const;
    // Until there is news, a wake() since the last wait, a stop, or the deadline.
    void wait(const std::stop_token& stop, std::optional<TimePoint> deadline);

  private:
    struct Slot {
        ViewerNews news;
        bool fresh = false;
    };
    // Of a session that is present; under the lock.
    template <class Change>
    void change(session::SessionId id, const Change& apply);
    void publish(session::SessionId id, Slot& slot);
    void wakeUp(); // under the lock

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    bool awake_ = false;
    std::optional<Error> closed_;
    session::SessionId last_id_ = 0;
    std::map<session::SessionId, Slot> slots_; // present sessions, and departed ones until taken
    std::vector<session::SessionId> fresh_;    // of these; no more often than once
};

} // namespace froxel::stream
