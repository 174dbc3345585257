#include "net/conversation.h"

#include "core/text.h"
#include "froxel/v1/server.pb.h"
#include "session/state_message.h"

#include <utility>

namespace froxel::net {

using protocol::CloseCode;
using session::CommandMessage;
using session::RejectCode;
using session::Rejection;

Conversation::~Conversation() {
    if (id_ != 0) {
        service_.serving->port->leave(id_);
        metrics_->sessionClosed();
    }
}

void Conversation::onMessage(protocol::ByteSpan message,
                             protocol::WireFormat format,
                             TimePoint now) {
    if (closing_) {
        return;
    }
    if (const auto command = reader_.read(message, format)) {
        handle(*command, now);
    } else {
        reject(command.error(), now);
    }
}

void Conversation::handle(const CommandMessage& message, TimePoint now) {
    if (const auto* hello = std::get_if<session::Hello>(&message.body)) {
        greet(*hello, now);
    } else if (std::holds_alternative<session::Ping>(message.body)) {
        answer(session::makePong(message.stamp));
    } else if (const auto* ack = std::get_if<session::Ack>(&message.body)) {
        onAck(message.stamp, ack->frame_id, now);
    } else if (state_) {
        applyCommand(message, now);
    } else if (early_.size() < kMaxEarlyCommands) {
        early_.push_back(message);
    } else {
        reject({RejectCode::kCapacity, message.stamp.seq, "",
                numberText(kMaxEarlyCommands) + " commands already wait for the scene"},
               now);
    }
}

void Conversation::greet(const session::Hello& hello, TimePoint now) {
    client_name_ = hello.client_name;
    if (service_.serving) {
        begin(now);
    } else {
        sayLoading();
    }
}

void Conversation::begin(TimePoint now) {
    const session::SessionContext& context = *service_.serving->context;
    auto state = session::initialState(context, now);
    const auto id = service_.serving->port->join(sink_, state, now);
    if (!id) {
        const bool full = id.error().code == ErrorCode::kCapacity;
        answer(session::makeError(
            {full ? RejectCode::kCapacity : RejectCode::kDevice, 0, "", id.error().message}));
        close(full ? CloseCode::kCapacity : CloseCode::kDeviceLost, "no session");
        return;
    }
    id_ = *id;
    metrics_->sessionOpened();
    state_ = state;
    welcome_ = state;
    answer(session::makeWelcome(id_, context, *state_));
    grantCredits();
    for (const CommandMessage& message : std::exchange(early_, {})) {
        applyCommand(message, now);
    }
}

void Conversation::applyCommand(const CommandMessage& message, TimePoint now) {
    auto next = session::apply(*state_, message, *service_.serving->context, now);
    if (!next) {
        reject(next.error(), now);
        return;
    }
    state_ = *next;
    service_.serving->port->update(id_, *state_, now);
    outbox_.putState();
}

void Conversation::onAck(const session::CommandStamp& stamp, uint64_t frame_id, TimePoint now) {
    if (window_.onAck(frame_id, now) == session::AckOutcome::kUnknown) {
        reject({RejectCode::kOutOfRange, stamp.seq, "frame_id",
                "frame_id is " + numberText(frame_id) + "; no such frame was sent"},
               now);
        return;
    }
    grantCredits();
}

void Conversation::onService(const ServiceStatus& status, TimePoint now) {
    if (closing_) {
        return;
    }
    service_ = status;
    if (status.draining) {
        answer(session::makeDraining(*status.draining));
        close(CloseCode::kDraining, "the server is going down");
    } else if (!greeted() || state_) {
        return;
    } else if (status.serving) {
        begin(now);
    } else {
        sayLoading();
    }
}

void Conversation::sayLoading() {
    v1::ServerMessage message;
    message.mutable_loading()->set_stage(service_.loading.stage);
    message.mutable_loading()->set_fraction(service_.loading.fraction);
    answer(message);
}

void Conversation::onFrame(session::ReadyFrame frame) {
    ++delivered_;
    if (closing_) {
        return;
    }
    window_.onProduced(frame.cost);
    if (outbox_.hasFrame()) {
        metrics_->frameDropped();
    }
    outbox_.putFrame(std::move(frame));
    grantCredits();
}

void Conversation::onRefused(const Error& error,
                             const session::SessionState& refused,
                             const std::optional<session::SessionState>& drawn,
                             TimePoint now) {
    // A newer state is on its way to the stream and will be tried in its turn.
    if (closing_ || !state_ || state_->version != refused.version) {
        return;
    }
    const bool unsupported = error.code == ErrorCode::kUnsupported;
    answer(session::makeError({unsupported ? RejectCode::kUnsupported : RejectCode::kCapacity,
                               refused.applied.seq, "", error.message}));
    if (!drawn && refused.settings == welcome_->settings) {
        close(CloseCode::kCapacity, "the first picture cannot be made");
        return;
    }
    // A client may have changed much before its first picture.
    const session::SessionState& good = drawn ? *drawn : *welcome_;
    const view::Lights& lights = good.settings.lights;
    state_->light_clock = state_->light_clock.withRate(now, lights.speed, lights.animate);
    state_->settings = good.settings;
    state_->encoding = good.encoding;
    ++state_->version;
    service_.serving->port->update(id_, *state_, now);
    outbox_.putState();
}

void Conversation::onDeviceLost(const Error& error) {
    if (!closing_) {
        answer(session::makeError({RejectCode::kDevice, 0, "", error.message}));
        close(CloseCode::kDeviceLost, "the device was lost");
    }
}

void Conversation::onHelloTimeout() {
    if (!closing_ && !greeted()) {
        close(CloseCode::kPolicy, "no hello within 5 s");
    }
}

void Conversation::reject(const Rejection& rejection, TimePoint now) {
    answer(session::makeError(rejection));
    if (rejection.code == RejectCode::kVersion) {
        close(CloseCode::kVersion, "protocol version");
    } else if (!rejects_.spend(now)) {
        answer(session::makeError({RejectCode::kRateLimit, rejection.ref_seq, "",
                                   "more than " + numberText(protocol::kMaxRejects) +
                                       " messages refused within " +
                                       numberText(protocol::kRejectPeriod.count()) + " s"}));
        close(CloseCode::kPolicy, "too many refused messages");
    }
}

void Conversation::answer(const v1::ServerMessage& message) {
    const auto format = reader_.replyFormat();
    if (!outbox_.putAnswer({protocol::encodeServerMessage(message, format), nullptr, format})) {
        close(CloseCode::kSlowConsumer, "answers are not read");
    }
}

void Conversation::close(CloseCode code, std::string reason) {
    if (!closing_) {
        closing_ = Closing{code, std::move(reason)};
        outbox_.keepAnswersOnly();
    }
}

// Room for what fits into the window, and for one more to wait in the slot so that it leaves with
// the next acknowledgement. Not at a window of one: there a link is slow, and a picture in the
// slot would grow old.
void Conversation::grantCredits() {
    uint64_t room = 0;
    if (window_.open() && !outbox_.hasFrame()) {
        room = window_.window() - window_.inFlight() + (window_.window() > 1 ? 1U : 0U);
    }
    if (id_ != 0 && delivered_ + room != granted_) {
        granted_ = delivered_ + room;
        service_.serving->port->grant(id_, granted_);
    }
}

std::optional<Outgoing> Conversation::nextMessage(TimePoint now) {
    switch (outbox_.next(window_.open())) {
    case Outbox::Next::kNothing:
        return {};
    case Outbox::Next::kAnswer:
        return outbox_.takeAnswer();
    case Outbox::Next::kState: {
        outbox_.takeState();
        const auto format = reader_.replyFormat();
        const auto message = session::makeStateChanged(*service_.serving->context, *state_);
        return Outgoing{protocol::encodeServerMessage(message, format), nullptr, format};
    }
    case Outbox::Next::kFrame:
        if (auto details = detailsMessage()) {
            return details;
        }
        return frameMessage(now);
    }
    return {};
}

// What the next picture's details say, where that is news: decided now, since pictures before it
// may have been replaced unsent.
std::optional<Outgoing> Conversation::detailsMessage() {
    const auto& details = outbox_.frame().record.stats.details;
    if (!details || details == told_details_) {
        return {};
    }
    told_details_ = details;
    const auto format = reader_.replyFormat();
    return Outgoing{protocol::encodeServerMessage(session::makeFrameDetails(*details), format),
                    nullptr, format};
}

Outgoing Conversation::frameMessage(TimePoint now) {
    session::ReadyFrame frame = outbox_.takeFrame();
    frame.record.send_wait_us = Microseconds(now - frame.ready_at).count();
    frame.record.dropped_count = outbox_.droppedCount();
    window_.onSent(frame.record.frame_id, now);
    grantCredits();
    metrics_->frameSent(frame.record);
    return {protocol::encodeFramePrefix(session::makeFrameHeader(frame.record)),
            std::move(frame.bytes), protocol::WireFormat::kBinary};
}

} // namespace froxel::net
