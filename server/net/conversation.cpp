#include "net/conversation.h"

#include "core/text.h"
#include "froxel/v1/server.pb.h"
#include "session/state_message.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace froxel::net {

using protocol::CloseCode;
using session::CommandMessage;
using session::RejectCode;
using session::Rejection;

Conversation::~Conversation() {
    leave();
}

void Conversation::leave() {
    if (!seat_ || left_) {
        return;
    }
    left_ = true;
    // A client that reads too slowly may find a better way here.
    const bool lost = !goodbye_ && (!closing_ || closing_->code == CloseCode::kSlowConsumer);
    lobby_->depart(*seat_, lost ? Departure::kLost : Departure::kLeft, Clock::now());
    metrics_->sessionClosed();
}

void Conversation::onDecoded(session::CommandResult<CommandMessage> command,
                             protocol::WireFormat format,
                             TimePoint now) {
    if (closing_) {
        return;
    }
    command = reader_.check(std::move(command), format);
    if (command) {
        handle(*command, now);
    } else {
        reject(command.error(), now);
    }
}

void Conversation::handle(const CommandMessage& message, TimePoint now) {
    if (std::holds_alternative<session::Hello>(message.body)) {
        greet(message, now);
    } else if (std::holds_alternative<session::Ping>(message.body)) {
        answer(session::makePong(message.stamp));
    } else if (const auto* ack = std::get_if<session::Ack>(&message.body)) {
        onAck(message.stamp, *ack, now);
    } else if (seat_) {
        onCommand(message, now);
    } else if (early_.size() < kMaxEarlyCommands) {
        early_.push_back(message);
    } else {
        reject({RejectCode::kCapacity, message.stamp.seq, "",
                numberText(kMaxEarlyCommands) + " commands already wait for the scene"},
               now);
    }
}

void Conversation::greet(const CommandMessage& message, TimePoint now) {
    const auto& hello = std::get<session::Hello>(message.body);
    pass_ = gate_ ? gate_->admit(hello.token) : std::nullopt;
    if (gate_ && !pass_) {
        const char* why = hello.token.empty() ? "token is missing" : "token is unknown";
        return reject({RejectCode::kToken, message.stamp.seq, "token", why}, now);
    }
    if (pass_ && pass_->account()) {
        caller_.token = pass_->account();
    }
    hello_ = hello;
    hello_.token.clear();
    if (service_.serving) {
        begin(now);
    } else {
        sayLoading();
    }
}

void Conversation::begin(TimePoint now) {
    auto seat = lobby_->enter(*service_.serving, hello_, caller_, viewer_, now);
    hello_.resume_token.clear();
    if (!seat) {
        const Closing& why = seat.error();
        const bool lost = why.code == CloseCode::kDeviceLost;
        tellError({lost ? RejectCode::kDevice : RejectCode::kCapacity, 0, "", why.reason});
        close(why.code, why.reason);
        return;
    }
    seat_ = std::move(*seat);
    metrics_->sessionOpened();
    sayWelcome();
    if (auto& picture = seat_->picture) {
        static_cast<void>(outbox_.putFrame(*std::exchange(picture, std::nullopt)));
    } else {
        video_lost_ = true; // if it is video: it begins with a key frame
    }
    grantCredits();
    mendVideo(now);
    for (const CommandMessage& message : std::exchange(early_, {})) {
        onCommand(message, now);
    }
}

void Conversation::sayWelcome() {
    session::WelcomePlace place;
    place.resume_token = seat_->resume_token;
    place.resume_grace = lobby_->resumeGrace();
    place.resumed = seat_->resumed;
    place.offers_depth = offersDepth();
    answer(seat_->session->welcome(seat_->place.member, std::move(place), told_placed_));
}

void Conversation::onCommand(const CommandMessage& message, TimePoint now) {
    if (const auto* pause = std::get_if<session::Pause>(&message.body)) {
        if (pause->paused != paused_ && !pauses_.take(now)) {
            return rejectRate(message.stamp, kPausesPerSecond, "pauses begun or ended", now);
        }
        setPaused(pause->paused, now);
    } else if (std::holds_alternative<session::RequestDepth>(message.body)) {
        requestDepth(message, now);
    } else if (std::holds_alternative<session::RequestKeyFrame>(message.body)) {
        requestKeyFrame(now);
    } else if (std::holds_alternative<session::SelectScene>(message.body)) {
        selectScene(message, now);
    } else if (session::setsState(message.body)) {
        applyCommand(message, now);
    } else {
        changeControl(message, now);
    }
}

void Conversation::rejectRate(const session::CommandStamp& stamp,
                              double per_second,
                              const std::string& what,
                              TimePoint now) {
    reject({RejectCode::kRateLimit, stamp.seq, "",
            "more than " + numberText(per_second) + " " + what + " a second"},
           now);
}

void Conversation::applyCommand(const CommandMessage& message, TimePoint now) {
    if (std::holds_alternative<session::PickLight>(message.body) && !picks_.take(now)) {
        return rejectRate(message.stamp, kPicksPerSecond, "lights picked", now);
    }
    if (auto applied = seat_->session->apply(seat_->place, message, now); !applied) {
        reject(applied.error(), now);
        return;
    }
    newest_ = message.stamp;
    outbox_.putState();
}

void Conversation::selectScene(const CommandMessage& message, TimePoint now) {
    if (!scenes_.take(now)) {
        return rejectRate(message.stamp, kScenesPerSecond, "scenes selected", now);
    }
    if (auto selected = seat_->session->selectScene(seat_->place, message, now); !selected) {
        reject(selected.error(), now);
        return;
    }
    newest_ = message.stamp;
    outbox_.putState();
}

void Conversation::changeControl(const CommandMessage& message, TimePoint now) {
    if (auto changed = seat_->session->changeControl(seat_->place, message.body); !changed) {
        Rejection rejection = changed.error();
        rejection.ref_seq = message.stamp.seq;
        reject(rejection, now);
    } else {
        lobby_->passIdleControl(*seat_->session, now); // to who asks
    }
}

// Pictures that come while it is paused, in a room, replace one another in the slot; video goes on
// with a key frame.
void Conversation::setPaused(bool paused, TimePoint now) {
    paused_ = paused;
    if (paused) {
        const uint32_t dropped_before = outbox_.droppedCount();
        video_lost_ = outbox_.interruptVideo() || video_lost_;
        countDrops(dropped_before);
        key_at_.reset();
    }
    seat_->session->setPaused(seat_->place, paused, now);
    grantCredits();
    mendVideo(now);
}

void Conversation::requestKeyFrame(TimePoint now) {
    key_at_ = seat_->session->requestKeyFrame(seat_->place, now);
}

bool Conversation::offersDepth() const {
    return seat_->session->offersDepth() && (!pass_ || pass_->depth());
}

void Conversation::requestDepth(const CommandMessage& message, TimePoint now) {
    const bool wanted = std::get<session::RequestDepth>(message.body).wanted;
    if (wanted == wants_depth_) {
        return;
    }
    if (wanted && !offersDepth()) {
        return reject({RejectCode::kUnsupported, message.stamp.seq, "wanted",
                       "this server sends you no depth"},
                      now);
    }
    if (!depth_requests_.take(now)) {
        return rejectRate(message.stamp, kDepthRequestsPerSecond, "requests for depth", now);
    }
    wants_depth_ = wanted;
    seat_->session->setWantsDepth(seat_->place, wanted, now);
}

void Conversation::onAck(const session::CommandStamp& stamp,
                         const session::Ack& ack,
                         TimePoint now) {
    const Seconds client = Microseconds(ack.receive_to_paint_us);
    switch (window_.onAck(ack.frame_id, now, client, Microseconds(ack.decode_us))) {
    case session::AckOutcome::kUnknown:
        reject({RejectCode::kOutOfRange, stamp.seq, "frame_id",
                "frame_id is " + numberText(ack.frame_id) + "; no such frame was sent"},
               now);
        return;
    case session::AckOutcome::kFresh:
        if (std::exchange(seat_->resumed, false)) {
            lobby_->settle(*seat_); // it saw a picture, and so Welcome before
        }
        seat_->session->noteAck(seat_->place, ack.frame_id, now);
        followLink(now);
        break;
    case session::AckOutcome::kStale:
        break;
    }
    grantCredits();
    mendVideo(now);
}

// Before a picture was sent nothing is acknowledged, so there is a session.
void Conversation::followLink(TimePoint now) {
    const session::SessionState state = seat_->session->state();
    rate_.setWanted(state.encoding, state.delivery);
    const session::Trip& trip = *window_.lastTrip();
    const session::RateStep step = rate_.onTrip(trip, now);
    metrics_->rateStepped(step);
    if (rate_.takeProbe()) {
        window_.probe();
    }
    session::Delivery delivery = rate_.delivery();
    delivery.link_rate = told_delivery_ ? told_delivery_->link_rate : std::nullopt;
    // In steps: the last digits of a rate are news to nobody.
    constexpr double kNews = 1.2;
    const auto rate = rate_.linkRate();
    const double told = delivery.link_rate.value_or(0);
    if (rate && (*rate > kNews * told || *rate * kNews < told)) {
        delivery.link_rate = rate;
    }
    if (told_delivery_ != delivery) {
        told_delivery_ = delivery;
        seat_->session->setDelivery(seat_->place, delivery);
    }
    // In a room pictures may be more than this link takes, as others' links take them: then fewer
    // come, as fresh as they can be.
    const bool bits_give = state.delivery.adaptive && !rate_.alone() &&
                           seat_->session->deliveredRung() >= delivery.rung;
    window_.setFloor(bits_give ? 2 : 1);
}

void Conversation::onService(const ServiceStatus& status, TimePoint now) {
    if (closing_) {
        return;
    }
    service_ = status;
    if (pass_ && !pass_->valid()) {
        tellError({RejectCode::kToken, 0, "token", "the token was removed"});
        close(CloseCode::kToken, "the token was removed");
    } else if (status.lost) {
        tellError({RejectCode::kDevice, 0, "", *status.lost});
        close(CloseCode::kDeviceLost, "the device was lost");
    } else if (status.draining) {
        drain(*status.draining);
    } else if (!greeted() || seat_) {
        return;
    } else if (status.serving) {
        begin(now);
    } else {
        sayLoading();
    }
}

void Conversation::drain(const Draining& draining) {
    if (!std::exchange(told_draining_, true)) {
        answer(session::makeDraining(draining.deadline, draining.reconnect_url));
    }
    if (draining.over || !seat_) {
        close(CloseCode::kDraining, "the server is going down");
    }
}

void Conversation::sayLoading() {
    answer(session::makeLoading(service_.loading));
}

void Conversation::onNotice(Notice notice) {
    if (auto* frame = std::get_if<session::ReadyFrame>(&notice)) {
        onFrame(std::move(*frame));
    } else if (closing_) {
        return;
    } else if (std::holds_alternative<StateNews>(notice)) {
        outbox_.putState();
    } else if (std::holds_alternative<RoomNews>(notice)) {
        outbox_.putRoom();
    } else if (std::holds_alternative<SceneNews>(notice)) {
        outbox_.putScene();
    } else if (const auto* rejection = std::get_if<Rejection>(&notice)) {
        tellError(*rejection);
    } else if (auto* closing = std::get_if<Closing>(&notice)) {
        close(closing->code, std::move(closing->reason));
    }
}

void Conversation::onFrame(session::ReadyFrame frame) {
    ++delivered_;
    if (closing_) {
        return;
    }
    if (const session::Delivered& with = frame.record.delivered;
        with.refinement == session::Refinement::kInteractive) {
        window_.onProduced(frame.cost);
        rate_.onProduced(frame.cost, with.scale);
    }
    const uint32_t dropped_before = outbox_.droppedCount();
    const TimePoint now = frame.ready_at;
    if (frame.record.key && frame.isVideo()) {
        key_at_.reset();
    }
    video_lost_ = outbox_.putFrame(std::move(frame)) == Outbox::Put::kLost;
    countDrops(dropped_before);
    grantCredits();
    mendVideo(now);
}

void Conversation::countDrops(uint32_t before) {
    for (uint32_t i = before; i < outbox_.droppedCount(); ++i) {
        metrics_->frameDropped();
    }
}

// Not before there is room for a key frame: a slow viewer of a room asks no more often than it
// can take one.
void Conversation::mendVideo(TimePoint now) {
    if (video_lost_ && seat_ && window_.open() && !outbox_.hasFrame() && !paused_) {
        requestKeyFrame(now);
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
    if (window_.open() && !outbox_.hasFrame() && !paused_) {
        room = window_.window() - window_.inFlight() + (window_.window() > 1 ? 1U : 0U);
    }
    if (seat_ && delivered_ + room != granted_) {
        granted_ = delivered_ + room;
        seat_->session->grant(seat_->place, granted_);
    }
}

std::optional<Outgoing> Conversation::nextMessage(TimePoint now) {
    if (key_at_ && *key_at_ <= now) {
        key_at_.reset();
        video_lost_ ? mendVideo(now) : requestKeyFrame(now);
    }
    switch (outbox_.next({.room = room_states_.nextAt(now) <= now,
                          .scene = scene_states_.nextAt(now) <= now,
                          .state = states_.nextAt(now) <= now,
                          .frame = window_.open() && !paused_})) {
    case Outbox::Next::kNothing:
        return {};
    case Outbox::Next::kAnswer:
        return outbox_.takeAnswer();
    case Outbox::Next::kRoom:
        static_cast<void>(room_states_.take(now));
        outbox_.takeRoom();
        return inReply(seat_->session->roomState(seat_->place.member));
    case Outbox::Next::kScene:
        static_cast<void>(scene_states_.take(now));
        outbox_.takeScene();
        saySceneNews();
        return nextMessage(now);
    case Outbox::Next::kState:
        static_cast<void>(states_.take(now));
        outbox_.takeState();
        return stateMessage();
    case Outbox::Next::kFrame:
        if (auto details = detailsMessage()) {
            return details;
        }
        if (auto depth = depthMessage()) {
            return depth;
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
    if (outbox_.hasScene()) {
        orAt(scene_states_.nextAt(now));
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
        close(CloseCode::kSlowConsumer, "the client does not read the answers");
    }
}

void Conversation::tellError(const Rejection& rejection) {
    metrics_->commandRejected(rejection.code);
    answer(session::makeError(rejection));
}

void Conversation::reject(const Rejection& rejection, TimePoint now) {
    spdlog::info("event=command_refused session={} seq={} code={} field={} reason={}", id(),
                 rejection.ref_seq, session::nameOf(rejection.code), logValue(rejection.field),
                 logValue(rejection.message));
    tellError(rejection);
    if (rejection.code == RejectCode::kVersion) {
        close(CloseCode::kVersion, "protocol version");
    } else if (rejection.code == RejectCode::kToken) {
        close(CloseCode::kToken, "no valid token");
    } else if (rejection.code == RejectCode::kControl || rejection.blameless) {
        return; // control may have gone while the command was on its way
    } else if (!rejects_.spend(now)) {
        tellError({RejectCode::kRateLimit, rejection.ref_seq, "",
                   "more than " + numberText(protocol::kMaxRejects) + " messages refused within " +
                       numberText(protocol::kRejectPeriod.count()) + " s"});
        close(CloseCode::kPolicy, "too many refused messages");
    }
}

void Conversation::onFlood(ReadBudget::Standing standing) {
    if (closing_ || standing == ReadBudget::Standing::kWithin) {
        return;
    }
    const std::string most = numberText(ReadBudget::kMessages) + " a second or " +
                             numberText(ReadBudget::kBytesPerSecond) + " bytes a second";
    tellError(
        {RejectCode::kRateLimit, 0, "",
         "more messages than " + most +
             "; the server now reads them more slowly, and slow messages count as more bytes"});
    if (standing == ReadBudget::Standing::kSpent) {
        close(CloseCode::kPolicy, "more messages than the server reads from one viewer");
    }
}

// Of several viewers each is answered by the number of its own command.
Outgoing Conversation::stateMessage() {
    session::SessionState state = seat_->session->newState(seat_->place);
    state.applied = newest_;
    const auto told = std::exchange(told_placed_, state.settings.lights.placed);
    return inReply(makeStateChanged(*state.scene, state, told));
}

void Conversation::saySceneNews() {
    for (v1::ServerMessage& message : seat_->session->newsOfScene(seat_->place, told_placed_)) {
        answer(std::move(message));
    }
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

// What the next picture shows, as a mesh, where the client has not got it yet.
std::optional<Outgoing> Conversation::depthMessage() {
    const session::ReadyFrame& frame = outbox_.frame();
    const uint64_t number = frame.record.depth_mesh;
    if (!wants_depth_ || !frame.depth || number == told_depth_) {
        return {};
    }
    told_depth_ = number;
    Outgoing message;
    message.head = protocol::encodeDepthPrefix(session::makeDepthMeshHeader(*frame.depth, number));
    // It lives as long as the mesh.
    message.body = SharedBytes(frame.depth, &frame.depth->bytes);
    depth_bytes_ += message.size();
    metrics_->depthSent(message.size());
    return message;
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
    if (!wants_depth_) {
        frame.record.depth_mesh = 0;
    }
    signRecord(frame.record);
    const session::Delivered& with = frame.record.delivered;
    window_.onSent(frame.record.frame_id, now,
                   {frame.bytes->size() + std::exchange(depth_bytes_, 0), with.rung,
                    with.refinement != session::Refinement::kInteractive});
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
