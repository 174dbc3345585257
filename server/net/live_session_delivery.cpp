// Which of a session's viewers gets which picture, and how pictures are made for all of them.
#include "net/live_session.h"
#include "session/refinement.h"

#include <algorithm>

namespace froxel::net {
namespace {

// Of what the refinement itself allows, since the rate is of the first, small pictures, their way
// counted in: less than the link's.
constexpr double kSlack = 5;

bool refined(const session::ReadyFrame& frame) {
    return frame.record.delivered.refinement >= session::Refinement::kHigh;
}

// Whether a link takes a refined picture in bearable time.
bool carries(const session::Delivery& delivery, const session::ReadyFrame& frame) {
    const double bits = 8.0 * static_cast<double>(frame.bytes->size());
    const Seconds most = kSlack * session::RefinementSchedule::kMostOfTheLink;
    return !delivery.link_rate || bits <= *delivery.link_rate * most.count();
}

} // namespace

void LiveSession::grant(const Place& place, uint64_t frame_total) {
    const std::lock_guard lock(mutex_);
    if (Member* member = find(place)) {
        member->granted = frame_total;
        updateGrant();
    }
}

// As many as the viewer with the most room takes; the others' slots keep the newest.
void LiveSession::updateGrant() {
    uint64_t room = 0;
    for (const auto& [id, member] : members_) {
        room = std::max(room, member.granted - std::min(member.granted, member.delivered));
    }
    if (!ended_ && delivered_ + room != granted_) {
        granted_ = delivered_ + room;
        serving_.port->grant(id_, granted_);
    }
}

void LiveSession::setDelivery(const Place& place, const session::Delivery& delivery) {
    Mail mail;
    const std::lock_guard lock(mutex_);
    Member* member = find(place);
    if (member == nullptr) {
        return;
    }
    member->delivery = delivery;
    updateDelivery();
    if (picture_ && refined(*picture_) && carries(delivery, *picture_)) {
        tellFrame(*member, *picture_, mail);
    }
}

void LiveSession::setPaused(const Place& place, bool paused, TimePoint now) {
    const std::lock_guard lock(mutex_);
    Member* member = find(place);
    if (member != nullptr && std::exchange(member->paused, paused) != paused) {
        member->watched_at = now;
        updateDelivery();
    }
}

void LiveSession::noteAck(const Place& place, uint64_t frame_id, TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (Member* member = find(place)) {
        member->acked_frame = std::max(member->acked_frame, frame_id);
        member->watched_at = now;
    }
}

// Whether the newest picture is a refined one, and the one before it is all that was asked for.
bool LiveSession::plainSuffices() const {
    return picture_ && refined(*picture_) && plain_ && plain_->record.key &&
           plain_->record.delivered.scale == 1 && plain_->record.delivered.rung == 0;
}

void LiveSession::tellFrame(Member& member, const session::ReadyFrame& frame, Mail& mail) {
    if (frame.record.frame_id > member.told_frame) {
        member.told_frame = frame.record.frame_id;
        ++member.delivered;
        mail.add(member.viewer, frame);
    }
}

void LiveSession::updateDelivery() {
    const session::Delivery* best = nullptr;
    for (const auto& [id, member] : members_) {
        if (member.delivery && !member.paused &&
            (best == nullptr || member.delivery->rung < best->rung)) {
            best = &*member.delivery;
        }
    }
    if (!ended_ && best != nullptr && *best != delivery_) {
        delivery_ = *best;
        serving_.port->setDelivery(id_, delivery_);
    }
}

uint32_t LiveSession::deliveredRung() const {
    const std::lock_guard lock(mutex_);
    return delivery_.rung;
}

void LiveSession::deliver(session::ReadyFrame frame) {
    Mail mail;
    const std::lock_guard lock(mutex_);
    ++delivered_;
    key_wanted_ = key_wanted_ && view::isVideo(state_.encoding.codec) &&
                  !(frame.record.key && frame.isVideo());
    if (!refined(frame)) {
        plain_ = frame;
    }
    picture_ = std::move(frame);
    // In a room, whose refined pictures are for its best link.
    const bool may_wait = members_.size() > 1 && plainSuffices();
    for (auto& [id, member] : members_) {
        if (!may_wait || !member.delivery || carries(*member.delivery, *picture_)) {
            tellFrame(member, *picture_, mail);
        }
    }
    updateGrant();
}

} // namespace froxel::net
