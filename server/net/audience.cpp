#include "net/audience.h"

#include "session/refinement.h"

#include <algorithm>
#include <utility>

namespace froxel::net {

using session::MemberId;
using session::RejectCode;
using session::Rejection;

namespace {

// Of what the refinement itself allows, since the rate is of the first, small pictures, their way
// counted in: less than the link's.
constexpr double kSlack = 5;

} // namespace

bool refined(const session::ReadyFrame& frame) {
    return frame.record.delivered.refinement >= session::Refinement::kHigh;
}

bool carries(const session::Delivery& delivery, const session::ReadyFrame& frame) {
    const double bits = 8.0 * static_cast<double>(frame.bytes->size());
    const Seconds most = kSlack * session::RefinementSchedule::kMostOfTheLink;
    return !delivery.link_rate || bits <= *delivery.link_rate * most.count();
}

Audience::Member& Audience::attach(const Place& place,
                                   std::weak_ptr<SessionViewer> viewer,
                                   settings::CodecSet codecs,
                                   TimePoint now,
                                   Mail& mail) {
    Member& member = members_.at(place.member);
    mail.add(member.viewer,
             Closing{protocol::CloseCode::kReplaced, "a newer connection continued this session"});
    member = {.connection = place.connection,
              .viewer = std::move(viewer),
              .codecs = codecs,
              .watched_at = now};
    return member;
}

Audience::Member* Audience::find(const Place& place) {
    const auto found = members_.find(place.member);
    const bool current = found != members_.end() && found->second.connection == place.connection;
    return current ? &found->second : nullptr;
}

void Audience::tellAll(Mail& mail, const Notice& notice) const {
    for (const auto& [id, member] : members_) {
        mail.add(member.viewer, notice);
    }
}

void Audience::tellRoom(Mail& mail) {
    for (auto& [id, member] : members_) {
        if (!std::exchange(member.has_room_news, true)) {
            mail.add(member.viewer, RoomNews{});
        }
    }
}

void Audience::tellState(Mail& mail, std::optional<MemberId> but) {
    for (auto& [id, member] : members_) {
        if (id != but && !std::exchange(member.has_state_news, true)) {
            mail.add(member.viewer, StateNews{});
        }
    }
}

void Audience::tellScene(Mail& mail) {
    for (auto& [id, member] : members_) {
        if (!std::exchange(member.has_scene_news, true)) {
            mail.add(member.viewer, SceneNews{});
        }
    }
}

void Audience::noteRoomTold(MemberId member) {
    if (const auto found = members_.find(member); found != members_.end()) {
        found->second.has_room_news = false;
    }
}

void Audience::tellFrame(Member& member, const session::ReadyFrame& frame, Mail& mail) {
    if (frame.record.frame_id > member.told_frame) {
        member.told_frame = frame.record.frame_id;
        ++member.delivered;
        mail.add(member.viewer, frame);
    }
}

void Audience::tellFrame(const session::ReadyFrame& frame, bool may_wait, Mail& mail) {
    for (auto& [id, member] : members_) {
        if (!may_wait || !member.delivery || carries(*member.delivery, frame)) {
            tellFrame(member, frame, mail);
        }
    }
}

// The others hear of the state, which is one piece of news however often it changes: nobody can
// have them sent away as slow readers.
void Audience::tellRefusal(const Error& error,
                           const session::CommandStamp& asked,
                           std::optional<MemberId> controller,
                           bool to_all,
                           const std::string& field,
                           Mail& mail) const {
    const auto hasAsked = [&asked](const auto& entry) {
        return entry.second.connection == asked.author;
    };
    const bool is_here = std::any_of(members_.begin(), members_.end(), hasAsked);
    const bool unsupported = error.code == ErrorCode::kUnsupported;
    for (const auto& entry : members_) {
        const bool answers = is_here ? hasAsked(entry) : entry.first == controller;
        if (answers || to_all) {
            mail.add(entry.second.viewer,
                     Rejection{unsupported ? RejectCode::kUnsupported : RejectCode::kCapacity,
                               hasAsked(entry) ? asked.seq : 0, field, error.message});
        }
    }
}

settings::CodecSet Audience::decodable() const {
    auto all = settings::CodecSet().set();
    for (const auto& [id, member] : members_) {
        all &= member.codecs;
    }
    return all;
}

bool Audience::wantsDepth() const {
    return std::any_of(members_.begin(), members_.end(),
                       [](const auto& entry) { return entry.second.wants_depth; });
}

uint64_t Audience::room() const {
    uint64_t room = 0;
    for (const auto& [id, member] : members_) {
        room = std::max(room, member.granted - std::min(member.granted, member.delivered));
    }
    return room;
}

const session::Delivery* Audience::best() const {
    const session::Delivery* best = nullptr;
    for (const auto& [id, member] : members_) {
        if (member.delivery && !member.paused &&
            (best == nullptr || member.delivery->rung < best->rung)) {
            best = &*member.delivery;
        }
    }
    return best;
}

bool Audience::takesFrames() const {
    return std::any_of(members_.begin(), members_.end(), [](const auto& entry) {
        return entry.second.connection != 0 && !entry.second.paused;
    });
}

TimePoint Audience::watchedUntil(const RestLimits& limits, const session::Room& room) const {
    TimePoint last{};
    for (const auto& [id, member] : members_) {
        if (room.find(id)->away) {
            return TimePoint::max(); // its grace time is another matter
        }
        const bool takes = !member.paused && member.acked_frame >= member.told_frame;
        last = std::max(last, member.watched_at + std::chrono::duration_cast<Clock::duration>(
                                                      takes ? limits.idle : limits.paused));
    }
    return last;
}

} // namespace froxel::net
