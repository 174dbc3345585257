// What a conversation writes: which message is next, and how each is made.
#include "froxel/v1/server.pb.h"
#include "net/conversation.h"
#include "session/state_message.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace froxel::net {

std::optional<Outgoing> Conversation::nextMessage(TimePoint now) {
    if (key_at_ && *key_at_ <= now) {
        key_at_.reset();
        video_lost_ ? mendVideo(now) : requestKeyFrame(now);
    }
    switch (outbox_.next(states_.nextAt(now) <= now, window_.open() && !paused_)) {
    case Outbox::Next::kNothing:
        return {};
    case Outbox::Next::kAnswer:
        return outbox_.takeAnswer();
    case Outbox::Next::kRoom:
        outbox_.takeRoom();
        return inReply(seat_->session->roomState(seat_->place.member));
    case Outbox::Next::kState:
        static_cast<void>(states_.take(now));
        outbox_.takeState();
        return stateMessage();
    case Outbox::Next::kFrame:
        if (auto details = detailsMessage()) {
            return details;
        }
        return frameMessage(now);
    }
    return {};
}

std::optional<TimePoint> Conversation::wakeAt(TimePoint now) const {
    if (closing_) {
        return {};
    }
    if (!outbox_.hasState()) {
        return key_at_;
    }
    const TimePoint state_at = states_.nextAt(now);
    return key_at_ ? std::min(*key_at_, state_at) : state_at;
}

Outgoing Conversation::inReply(const v1::ServerMessage& message) const {
    const auto format = reader_.replyFormat();
    return {protocol::encodeServerMessage(message, format), nullptr, format};
}

// Of several viewers each is answered by the number of its own command.
Outgoing Conversation::stateMessage() {
    session::SessionState state = seat_->session->state();
    state.applied = newest_;
    const auto told = std::exchange(told_placed_, state.settings.lights.placed);
    return inReply(makeStateChanged(seat_->session->context(), state, told));
}

// What the next picture's details say, where that is news: decided now, since pictures before it
// may have been replaced unsent.
std::optional<Outgoing> Conversation::detailsMessage() {
    const auto& details = outbox_.frame().record.stats.details;
    if (!details || details == told_details_) {
        return {};
    }
    told_details_ = details;
    return inReply(session::makeFrameDetails(*details));
}

// A picture echoes the newest of this connection's own commands that it shows: the one behind it,
// or, where that was another viewer's, the last one before control went.
void Conversation::signRecord(session::FrameRecord& record) {
    if (record.applied.author == seat_->place.connection) {
        shown_ = record.applied;
        return;
    }
    if (!seat_->session->controls(seat_->place)) {
        shown_ = newest_;
    }
    if (record.applied.author != 0) {
        record.queue_us = 0; // waited for by someone else
    }
    record.applied = shown_;
}

Outgoing Conversation::frameMessage(TimePoint now) {
    session::ReadyFrame frame = outbox_.takeFrame();
    frame.record.send_wait_us = Microseconds(now - frame.ready_at).count();
    frame.record.dropped_count = outbox_.droppedCount();
    signRecord(frame.record);
    const session::Delivered& with = frame.record.delivered;
    window_.onSent(
        frame.record.frame_id, now,
        {frame.bytes->size(), with.rung, with.refinement != session::Refinement::kInteractive});
    frame.record.queue_delay_us = Microseconds(rate_.queueDelay()).count();
    frame.record.link_bits_per_s = rate_.linkRate().value_or(0);
    grantCredits();
    metrics_->frameSent(frame.record);
    spdlog::debug("event=frame_sent session={} frame={} bytes={} render_us={:.0f} encode_us={:.0f} "
                  "send_wait_us={:.0f}",
                  id(), frame.record.frame_id, frame.record.encoded_bytes, frame.record.render_us,
                  frame.record.encode_us, frame.record.send_wait_us);
    return {protocol::encodeFramePrefix(session::makeFrameHeader(frame.record)),
            std::move(frame.bytes), protocol::WireFormat::kBinary};
}

} // namespace froxel::net
