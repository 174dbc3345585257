#include "session/room.h"

#include "core/assert.h"
#include "core/text.h"
#include "protocol/limits.h"

#include <algorithm>

namespace froxel::session {

bool isRoomName(std::string_view text) {
    constexpr std::string_view kAllowed =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
    return !text.empty() && text.size() <= protocol::kMaxRoomNameBytes &&
           text.find_first_not_of(kAllowed) == std::string_view::npos;
}

const Room::Member* Room::find(MemberId id) const {
    const auto found = std::find_if(members_.begin(), members_.end(),
                                    [id](const Member& member) { return member.id == id; });
    return found == members_.end() ? nullptr : &*found;
}

void Room::add(MemberId id, std::string name) {
    FROXEL_ASSERT(id != 0 && find(id) == nullptr, "a member of this id is there");
    if (members_.empty()) {
        controller_ = id;
    }
    members_.push_back({id, std::move(name), false});
    ++version_;
}

void Room::setAway(MemberId id, bool away) {
    for (Member& member : members_) {
        if (member.id == id && member.away != away) {
            member.away = away;
            ++version_;
        }
    }
    if (!away && controller_ == 0) {
        passOn(); // it may have asked before control became free
    }
}

void Room::remove(MemberId id) {
    if (find(id) == nullptr) {
        return;
    }
    std::erase_if(members_, [id](const Member& member) { return member.id == id; });
    std::erase(asking_, id);
    if (controller_ == id) {
        passOn();
    }
    ++version_;
}

// Not one who is away: nobody would be there to use it.
MemberId Room::heir() const {
    const auto next = std::find_if(asking_.begin(), asking_.end(),
                                   [this](MemberId id) { return !find(id)->away; });
    return next == asking_.end() ? 0 : *next;
}

void Room::passOn() {
    controller_ = heir();
    std::erase(asking_, controller_);
}

void Room::requestControl(MemberId id) {
    const bool asks = std::find(asking_.begin(), asking_.end(), id) != asking_.end();
    if (find(id) == nullptr || controller_ == id || asks) {
        return;
    }
    if (controller_ == 0) {
        controller_ = id;
    } else {
        asking_.push_back(id);
    }
    ++version_;
}

void Room::releaseControl(MemberId id) {
    if (controller_ == id) {
        passOn();
        ++version_;
    } else if (std::erase(asking_, id) > 0) {
        ++version_;
    }
}

CommandResult<void> Room::giveControl(MemberId from, MemberId to) {
    if (auto allowed = mayControl(from); !allowed) {
        return allowed;
    }
    const Member* receiver = find(to);
    if (receiver == nullptr || receiver->away) {
        return Rejection{RejectCode::kOutOfRange, 0, "member_id",
                         "member_id is " + numberText(to) +
                             (receiver == nullptr ? "; this room has no such viewer"
                                                  : "; this viewer's connection is lost")};
    }
    if (to != from) {
        controller_ = to;
        std::erase(asking_, to);
        ++version_;
    }
    return {};
}

CommandResult<void> Room::mayControl(MemberId id) const {
    if (controller_ == id) {
        return {};
    }
    const std::string who = controller_ == 0
                                ? "nobody controls room "
                                : "viewer " + numberText(controller_) + " controls room ";
    return Rejection{RejectCode::kControl, 0, "", who + name_ + "; ask for control first"};
}

} // namespace froxel::session
