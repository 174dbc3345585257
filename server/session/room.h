// Who shares a session, and who of them controls it. Pure: no threads, no clock, no sockets.
//
// The first member controls. Free control goes to whoever asks for it next; held control goes where
// its holder gives it, or, when the holder releases it or leaves for good, to the member who has
// asked for it longest. A member whose connection is lost keeps its place, and control if it has
// it, until it is removed.
#pragma once

#include "session/rejection.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::session {

using MemberId = uint64_t; // from 1; unique on a server

// 1 to protocol::kMaxRoomNameBytes of A-Z a-z 0-9 . _ -
[[nodiscard]] bool isRoomName(std::string_view text);

class Room {
  public:
    struct Member {
        MemberId id = 0;
        std::string name; // untrusted text
        bool away = false;
    };

    // `name` is empty for a session of one's own.
    explicit Room(std::string name) : name_(std::move(name)) {}

    void add(MemberId id, std::string name);
    void setAway(MemberId id, bool away);
    void remove(MemberId id);

    // Refused only for what GiveControl's sender may not do: kControl, kOutOfRange.
    void requestControl(MemberId id);
    void releaseControl(MemberId id);
    [[nodiscard]] CommandResult<void> giveControl(MemberId from, MemberId to);
    // Why `id` may not set the view's state: kControl, saying who may.
    [[nodiscard]] CommandResult<void> mayControl(MemberId id) const;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] bool shared() const { return !name_.empty(); }
    [[nodiscard]] bool empty() const { return members_.empty(); }
    [[nodiscard]] MemberId controller() const { return controller_; } // 0: free
    [[nodiscard]] const std::vector<Member>& members() const { return members_; }
    // Longest wait first.
    [[nodiscard]] const std::vector<MemberId>& asking() const { return asking_; }
    // Who of them is here and gets control when its holder lets it go; 0: nobody.
    [[nodiscard]] MemberId heir() const;
    [[nodiscard]] const Member* find(MemberId id) const;
    // Grows with every change that a RoomState would show.
    [[nodiscard]] uint64_t version() const { return version_; }

  private:
    void passOn();

    const std::string name_;
    std::vector<Member> members_; // as they came
    std::vector<MemberId> asking_;
    MemberId controller_ = 0;
    uint64_t version_ = 1;
};

} // namespace froxel::session
