// What a session tells its viewers, and how it gets to them: after every lock was let go.
#pragma once

#include "net/closing.h"
#include "session/rejection.h"
#include "session/room.h"
#include "session/stream_port.h"

#include <memory>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

namespace froxel::net {

// A change that a session announces to one of its viewers.
struct StateNews {}; // LiveSession::state() changed
struct RoomNews {};  // the state of the room changed
struct SceneNews {}; // newsOfScene() changed
using Notice =
    std::variant<session::ReadyFrame, StateNews, RoomNews, SceneNews, session::Rejection, Closing>;

// A viewer's connection, as its session sees it.
class SessionViewer {
  public:
    virtual ~SessionViewer() = default;
    // On any thread; must not block.
    virtual void tell(Notice notice) = 0;
};

// Notices on their way. Posted when it ends, which must be after every lock was let go: a viewer
// may end there, and take its leave.
class Mail {
  public:
    Mail() = default;
    ~Mail();
    Mail(const Mail&) = delete;
    Mail& operator=(const Mail&) = delete;

    void add(const std::weak_ptr<SessionViewer>& viewer, Notice notice);

  private:
    std::vector<std::pair<std::shared_ptr<SessionViewer>, Notice>> letters_;
};

// Gives what step(mail) does, under the lock; its mail goes out when that is let go.
template <class Step>
auto underLock(std::mutex& mutex, const Step& step) {
    Mail mail;
    const std::lock_guard lock(mutex);
    return step(mail);
}

// One connection of one member: what a newer connection of the same member has replaced has no
// effect any more.
struct Place {
    session::MemberId member = 0;
    uint64_t connection = 0; // unique on a server
};

} // namespace froxel::net
