// Scenes that clients send in the bodies of requests. They are kept in memory, and no longer than
// the answer takes. What counts is what has come: who announces much and sends little keeps nobody
// out. Any thread.
#pragma once

#include "guest/guest_shelf.h"
#include "net/http_site.h"
#include "session/account.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

namespace froxel::net {

class GuestBodies : public std::enable_shared_from_this<GuestBodies> {
  public:
    // Of the largest body: that those of all clients, and of one account, may take together.
    static constexpr uint64_t kAtOnce = 4;
    static constexpr uint64_t kAtOnceOfAccount = 2;

    // `most_bytes`: of one; 0: none may come.
    GuestBodies(std::shared_ptr<guest::GuestShelf> shelf, uint64_t most_bytes)
        : shelf_(std::move(shelf)), most_bytes_(most_bytes) {}

    // As HttpSite::receive(), of a request with this Content-Type, which matters if it is a form.
    // `then` is called with the scene when all of it is there, and does as
    // HttpSite::answerLater(). No account: the limit of one account does not hold.
    using Then = std::function<HttpSite::CallOff(guest::GuestShelf::SharedHold scene,
                                                 std::function<void(LateAnswer)> done)>;
    [[nodiscard]] HttpSite::Received receive(const std::optional<session::Account>& account,
                                             std::string_view content_type,
                                             uint64_t size_bytes,
                                             Then then);

  private:
    class Body;
    // The bytes of a body that have come, until this ends.
    class Room;

    // Under the lock: why there is no room for so many more.
    [[nodiscard]] std::optional<Response> whyNoRoom(const std::optional<session::Account>& account,
                                                    uint64_t bytes) const;

    const std::shared_ptr<guest::GuestShelf> shelf_;
    const uint64_t most_bytes_;
    std::mutex mutex_;
    uint64_t taken_bytes_ = 0;
    std::map<session::Account, uint64_t> taken_by_; // none has 0
};

} // namespace froxel::net
