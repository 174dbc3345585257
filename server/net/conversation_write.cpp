// What a conversation writes: which message is next, and how each is made.
#include "core/text.h"
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
    switch (outbox_.next(room_states_.nextAt(now) <= now, states_.nextAt(now) <= now,
                         window_.open() && !paused_)) {
    case Outbox::Next::kNothing:
        return {};
    case Outbox::Next::kAnswer:
        return outbox_.takeAnswer();
    case Outbox::Next::kRoom:
        static_cast<void>(room_states_.take(now));
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
    std::optional<TimePoint> at = key_at_;
    const auto orAt = [&at](TimePoint other) { at = at ? std::min(*at, other) : other; };
    if (outbox_.hasRoom()) {
        orAt(room_states_.nextAt(now));
    }
    if (outbox_.hasState()) {
        orAt(states_.nextAt(now));
    }
    return at;
}

Outgoing Conversation::inReply(v1::ServerMessage message) const {
    Outgoing reply;
    reply.format = reader_.replyFormat();
    if (message.ByteSizeLong() > kLongBytes) {
        reply.unmade = std::make_shared<const v1::ServerMessage>(std::move(message));
    } else {
        reply.head = protocol::encodeServerMessage(message, reply.format);
    }
    return reply;
}

void Conversation::answer(v1::ServerMessage message) {
    if (!outbox_.putAnswer(inReply(std::move(message)))) {
        close(protocol::CloseCode::kSlowConsumer, "answers are not read");
    }
}

void Conversation::tellError(const session::Rejection& rejection) {
    metrics_->commandRejected(rejection.code);
    answer(session::makeError(rejection));
}

void Conversation::reject(const session::Rejection& rejection, TimePoint now) {
    using session::RejectCode;
    spdlog::info("event=command_refused session={} seq={} code={} field={} reason={}", id(),
                 rejection.ref_seq, session::nameOf(rejection.code), logValue(rejection.field),
                 logValue(rejection.message));
    tellError(rejection);
    if (rejection.code == RejectCode::kVersion) {
        close(protocol::CloseCode::kVersion, "protocol version");
    } else if (rejection.code == RejectCode::kToken) {
        close(protocol::CloseCode::kToken, "no valid token");
    } else if (rejection.code == RejectCode::kControl || rejection.blameless) {
        return; // control may have gone while the command was on its way
    } else if (!rejects_.spend(now)) {
        tellError({RejectCode::kRateLimit, rejection.ref_seq, "",
                   "more than " + numberText(protocol::kMaxRejects) + " messages refused within " +
                       numberText(protocol::kRejectPeriod.count()) + " s"});
        close(protocol::CloseCode::kPolicy, "too many refused messages");
    }
}

void Conversation::onFlood(ReadBudget::Standing standing) {
    if (closing_ || standing == ReadBudget::Standing::kWithin) {
        return;
    }
    const std::string most = numberText(ReadBudget::kBytesPerSecond) + " bytes a second";
    tellError({session::RejectCode::kRateLimit, 0, "",
               "messages are more than " + most +
                   ", and what takes long counts as more; they are read more slowly"});
    if (standing == ReadBudget::Standing::kSpent) {
        close(protocol::CloseCode::kPolicy, "more messages than are read of one viewer");
    }
}

// Of several viewers each is answered by the number of its own command.
Outgoing Conversation::stateMessage() {
    session::SessionState state = seat_->session->newState(seat_->place);
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
