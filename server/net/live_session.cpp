#include "net/live_session.h"

#include "froxel/v1/server.pb.h"
#include "session/scene_change.h"

#include <algorithm>

namespace froxel::net {

using session::CommandResult;
using session::MemberId;
using session::RejectCode;
using session::Rejection;
using session::SessionState;

Result<std::shared_ptr<LiveSession>>
LiveSession::open(const Serving& serving, std::string room, Caller opener, TimePoint now) {
    // The constructor is private.
    std::shared_ptr<LiveSession> live(
        new LiveSession(serving, std::move(room), std::move(opener), now));
    const auto id = serving.port->join(live, live->first_, live->opener_.account(), now);
    if (!id) {
        live->ended_ = true;
        return id.error();
    }
    live->id_ = *id;
    return live;
}

LiveSession::LiveSession(Serving serving, std::string room, Caller opener, TimePoint now)
    : serving_(std::move(serving)), opener_(std::move(opener)), room_(std::move(room)),
      control_used_(now), first_(session::beginOn(serving_.context, now)), state_(first_) {}

LiveSession::~LiveSession() {
    callOff();
    if (!ended_) {
        serving_.port->leave(id_);
    }
}

void LiveSession::addMember(MemberId member, std::string name, Mail& mail) {
    const std::lock_guard lock(mutex_);
    audience_.tellRoom(mail);
    room_.add(member, std::move(name));
    used_by_ = used_by_ == 0 ? room_.controller() : used_by_;
    audience_.add(member);
}

std::optional<session::ReadyFrame> LiveSession::attach(const Place& place,
                                                       std::weak_ptr<SessionViewer> viewer,
                                                       settings::CodecSet codecs,
                                                       TimePoint now,
                                                       Mail& mail) {
    const std::lock_guard lock(mutex_);
    Audience::Member& member = audience_.attach(place, std::move(viewer), codecs, now, mail);
    if (room_.find(place.member)->away) {
        room_.setAway(place.member, false);
        audience_.tellRoom(mail);
    }
    member.told_scene = scene_.count(); // by Welcome
    if (scene_.waits()) {
        member.has_scene_news = true;
        mail.add(member.viewer, SceneNews{});
    }
    updateCodecs(now, mail);
    updateDepth(now);
    updateGrant();
    updateDelivery();
    auto picture = plainSuffices() ? plain_ : picture_;
    const auto decodes = [&codecs](const session::ReadyFrame& frame) {
        return frame.record.key &&
               settings::contains(codecs, frame.record.delivered.encoding.codec);
    };
    if (!picture || !decodes(*picture)) {
        return {};
    }
    picture->ready_at = now; // it waited for nobody until now
    member.told_frame = picture->record.frame_id;
    return picture;
}

void LiveSession::detach(const Place& place, Mail& mail) {
    const std::lock_guard lock(mutex_);
    Audience::Member* member = audience_.find(place);
    if (member == nullptr) {
        return;
    }
    *member = {};
    room_.setAway(place.member, true);
    updateCodecs(Clock::now(), mail);
    updateDepth(Clock::now());
    updateGrant();
    updateDelivery();
    audience_.tellRoom(mail);
}

bool LiveSession::removeMember(MemberId member, Mail& mail) {
    const std::lock_guard lock(mutex_);
    audience_.remove(member);
    room_.remove(member);
    const bool last = audience_.empty();
    if (!last) {
        updateCodecs(Clock::now(), mail);
        updateDepth(Clock::now());
        updateGrant();
        updateDelivery();
    } else if (!std::exchange(ended_, true)) {
        callOff();
        serving_.port->leave(id_);
    }
    audience_.tellRoom(mail);
    return last;
}

CommandResult<void>
LiveSession::apply(const Place& place, const session::CommandMessage& message, TimePoint now) {
    return underLock(mutex_, [&](Mail& mail) -> CommandResult<void> {
        Audience::Member* member = audience_.find(place);
        if (member == nullptr) {
            return {}; // a newer connection was sent word to close this one
        }
        if (auto allowed = room_.mayControl(place.member); !allowed) {
            Rejection rejection = allowed.error();
            rejection.ref_seq = message.stamp.seq;
            return rejection;
        }
        session::CommandMessage signed_message = message;
        signed_message.stamp.author = place.connection;
        auto next = session::apply(state_, signed_message, *state_.scene, now);
        if (!next) {
            return next.error();
        }
        state_ = *next;
        member->watched_at = control_used_ = now;
        used_by_ = place.member;
        serving_.port->update(id_, state_, now);
        audience_.tellState(mail, place.member);
        return {};
    });
}

CommandResult<void> LiveSession::selectScene(const Place& place,
                                             const session::CommandMessage& message,
                                             TimePoint now) {
    return underLock(mutex_, [&](Mail& mail) -> CommandResult<void> {
        Audience::Member* member = audience_.find(place);
        if (member == nullptr) {
            return {};
        }
        const auto refuse = [&message](Rejection rejection) {
            rejection.ref_seq = message.stamp.seq;
            return rejection;
        };
        if (auto allowed = room_.mayControl(place.member); !allowed) {
            return refuse(allowed.error());
        }
        member->watched_at = control_used_ = now;
        used_by_ = place.member;
        const std::string& id = std::get<session::SelectScene>(message.body).id;
        if (scene_.waitsFor(id)) {
            return {};
        }
        session::CommandStamp stamp = message.stamp;
        stamp.author = place.connection;
        if (id == state_.scene->scene_id) {
            callOff();
            audience_.tellScene(mail);
            return {};
        }
        auto scene = serving_.scenes->want(id, shared_from_this());
        if (!scene) {
            Rejection refused{RejectCode::kOutOfRange, 0, "scene",
                              "scene " + scene.error().message};
            refused.blameless = true; // the list that it was chosen from may be old
            return refuse(std::move(refused));
        }
        callOff();
        if (*scene) {
            show(*scene, stamp, now, mail);
        } else {
            scene_.await(id, stamp);
            audience_.tellScene(mail);
        }
        return {};
    });
}

void LiveSession::callOff() {
    scene_.callOff(serving_.scenes, weak_from_this());
}

void LiveSession::show(const session::SharedContext& scene,
                       const session::CommandStamp& stamp,
                       TimePoint now,
                       Mail& mail) {
    state_ = session::withScene(state_, first_, scene, stamp, now);
    first_ = session::beginOn(scene, now);
    scene_.show(stamp);
    picture_.reset(); // whoever comes before the next one waits for it
    plain_.reset();
    serving_.port->update(id_, state_, now);
    audience_.tellScene(mail);
    audience_.tellState(mail);
}

void LiveSession::onSceneProgress(const std::string& id, const Progress& progress) {
    underLock(mutex_, [&](Mail& mail) {
        if (scene_.waitsFor(id)) {
            scene_.note(progress);
            audience_.tellScene(mail);
        }
    });
}

void LiveSession::onScene(const std::string& id, Result<session::SharedContext> scene) {
    underLock(mutex_, [&](Mail& mail) {
        if (!scene_.waitsFor(id)) {
            return;
        }
        const session::CommandStamp stamp = scene_.take();
        if (scene) {
            show(*scene, stamp, Clock::now(), mail);
            return;
        }
        audience_.tellRefusal(scene.error(), stamp, room_.controller(), false, "scene", mail);
        audience_.tellScene(mail);
    });
}

std::vector<v1::ServerMessage> LiveSession::newsOfScene(const Place& place,
                                                        settings::PlacedLights& placed) {
    const std::lock_guard lock(mutex_);
    std::vector<v1::ServerMessage> messages;
    Audience::Member* member = audience_.find(place);
    if (member == nullptr) {
        return messages;
    }
    member->has_scene_news = false;
    if (std::exchange(member->told_scene, scene_.count()) != scene_.count()) {
        const session::CommandStamp& stamp = scene_.shownFor();
        const bool asked = stamp.author == place.connection;
        messages.push_back(session::makeSceneChanged(state_, first_, asked ? stamp.seq : 0));
        placed = state_.settings.lights.placed;
    }
    if (const auto& awaited = scene_.awaited()) {
        messages.push_back(session::makeSceneLoading(awaited->id, awaited->progress));
    } else if (member->told_loading) {
        messages.push_back(session::makeSceneLoading({}, {}));
    }
    member->told_loading = scene_.waits();
    if (std::exchange(member->told_compiling, compiling_) != compiling_) {
        messages.push_back(session::makeLoading({compiling_ ? "compiling shaders" : "", 0}));
    }
    return messages;
}

CommandResult<void> LiveSession::changeControl(const Place& place,
                                               const session::Command& command) {
    return underLock(mutex_, [&](Mail& mail) -> CommandResult<void> {
        if (audience_.find(place) == nullptr) {
            return {};
        }
        if (!room_.shared()) {
            return Rejection{RejectCode::kUnsupported, 0, "",
                             "this session is not in a room; you control it"};
        }
        const uint64_t before = room_.version();
        if (const auto* give = std::get_if<session::GiveControl>(&command)) {
            if (auto given = room_.giveControl(place.member, give->member_id); !given) {
                return given;
            }
        } else if (std::holds_alternative<session::RequestControl>(command)) {
            room_.requestControl(place.member);
        } else {
            room_.releaseControl(place.member);
        }
        if (room_.version() != before) {
            audience_.tellRoom(mail);
        }
        return {};
    });
}

std::optional<TimePoint> LiveSession::passIdleControl(Seconds limit, TimePoint now, Mail& mail) {
    const std::lock_guard lock(mutex_);
    const auto noteHolder = [&] {
        if (std::exchange(used_by_, room_.controller()) != room_.controller()) {
            control_used_ = now;
        }
    };
    noteHolder();
    if (used_by_ == 0 || room_.heir() == 0) {
        return {};
    }
    const auto length = std::chrono::duration_cast<Clock::duration>(limit);
    if (control_used_ + length > now) {
        return control_used_ + length;
    }
    room_.releaseControl(used_by_);
    noteHolder();
    audience_.tellRoom(mail);
    return room_.heir() == 0 ? std::nullopt : std::optional(now + length);
}

void LiveSession::takeControl(Mail& mail) {
    const std::lock_guard lock(mutex_);
    room_.releaseControl(room_.controller());
    audience_.tellRoom(mail);
}

void LiveSession::tellClosing(const Closing& closing, Mail& mail) const {
    const std::lock_guard lock(mutex_);
    audience_.tellAll(mail, closing);
}

TimePoint LiveSession::watchedUntil(const RestLimits& limits) const {
    const std::lock_guard lock(mutex_);
    return audience_.watchedUntil(limits, room_);
}

// A room has video only while all who are here decode it.
void LiveSession::updateCodecs(TimePoint now, Mail& mail) {
    state_.decodable = audience_.decodable();
    const settings::Codec before = state_.encoding.codec;
    keepDecodable();
    if (state_.encoding.codec != before) {
        ++state_.version;
        serving_.port->update(id_, state_, now);
        audience_.tellState(mail);
    }
}

void LiveSession::setWantsDepth(const Place& place, bool wants, TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (Audience::Member* member = audience_.find(place)) {
        member->wants_depth = wants;
        updateDepth(now);
    }
}

// As long as any asks for it.
void LiveSession::updateDepth(TimePoint now) {
    const bool sends = serving_.offers_depth && audience_.wantsDepth();
    if (std::exchange(state_.sends_depth, sends) == sends) {
        return;
    }
    if (sends) {
        ++state_.version; // so that a picture with depth is drawn where nothing moves
    }
    serving_.port->update(id_, state_, now);
}

void LiveSession::keepDecodable() {
    if (!settings::contains(state_.decodable, state_.encoding.codec)) {
        state_.encoding.codec = settings::kPlainCodec;
    }
}

std::optional<TimePoint> LiveSession::requestKeyFrame(const Place& place, TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (audience_.find(place) == nullptr || !settings::rowOf(state_.encoding.codec).frames_depend ||
        video_.waits()) {
        return {};
    }
    if (const auto later = video_.want(now)) {
        return later;
    }
    ++state_.key_requests;
    ++state_.version; // so that a picture is drawn where nothing moves
    serving_.port->update(id_, state_, now);
    return {};
}

SessionState LiveSession::newState(const Place& place) {
    const std::lock_guard lock(mutex_);
    if (Audience::Member* member = audience_.find(place)) {
        member->has_state_news = false;
    }
    return state_;
}

SessionState LiveSession::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

bool LiveSession::controls(const Place& place) const {
    const std::lock_guard lock(mutex_);
    return room_.controller() == place.member;
}

v1::ServerMessage LiveSession::roomState(MemberId you) {
    const std::lock_guard lock(mutex_);
    audience_.noteRoomTold(you);
    return session::makeRoomState(room_, you);
}

v1::ServerMessage LiveSession::welcome(MemberId you,
                                       session::WelcomePlace place,
                                       settings::PlacedLights& placed) const {
    const std::lock_guard lock(mutex_);
    placed = state_.settings.lights.placed;
    if (room_.shared()) {
        place.room = &room_;
        place.member = you;
    }
    if (state_.version != first_.version) {
        place.defaults = &first_;
    }
    v1::ServerMessage message = session::makeWelcome(id_, *state_.scene, state_);
    session::addPlace(message, *state_.scene, place);
    return message;
}

void LiveSession::grant(const Place& place, uint64_t frame_total) {
    const std::lock_guard lock(mutex_);
    if (Audience::Member* member = audience_.find(place)) {
        member->granted = frame_total;
        updateGrant();
    }
}

// As many as the viewer with the most room takes; the others' slots keep the newest.
void LiveSession::updateGrant() {
    const uint64_t room = audience_.room();
    if (!ended_ && delivered_ + room != granted_) {
        granted_ = delivered_ + room;
        serving_.port->grant(id_, granted_);
    }
}

void LiveSession::setDelivery(const Place& place, const session::Delivery& delivery) {
    underLock(mutex_, [&](Mail& mail) {
        Audience::Member* member = audience_.find(place);
        if (member == nullptr) {
            return;
        }
        member->delivery = delivery;
        updateDelivery();
        if (picture_ && refined(*picture_) && carries(delivery, *picture_)) {
            Audience::tellFrame(*member, *picture_, mail);
        }
    });
}

void LiveSession::setPaused(const Place& place, bool paused, TimePoint now) {
    const std::lock_guard lock(mutex_);
    Audience::Member* member = audience_.find(place);
    if (member != nullptr && std::exchange(member->paused, paused) != paused) {
        member->watched_at = now;
        updateDelivery();
    }
}

void LiveSession::noteAck(const Place& place, uint64_t frame_id, TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (Audience::Member* member = audience_.find(place)) {
        member->acked_frame = std::max(member->acked_frame, frame_id);
        member->watched_at = now;
    }
}

// Whether the newest picture is a refined one, and the one before it is all that was asked for.
bool LiveSession::plainSuffices() const {
    return picture_ && refined(*picture_) && plain_ && plain_->record.key &&
           plain_->record.delivered.scale == 1 && plain_->record.delivered.rung == 0;
}

void LiveSession::updateDelivery() {
    const session::Delivery* best = audience_.best();
    if (!ended_ && best != nullptr && *best != delivery_) {
        delivery_ = *best;
        serving_.port->setDelivery(id_, delivery_);
    }
    const bool takes = audience_.takesFrames();
    if (!ended_ && std::exchange(takes_frames_, takes) != takes) {
        serving_.port->setTakesFrames(id_, takes);
    }
}

uint32_t LiveSession::deliveredRung() const {
    const std::lock_guard lock(mutex_);
    return delivery_.rung;
}

void LiveSession::deliver(session::ReadyFrame frame) {
    underLock(mutex_, [&](Mail& mail) {
        ++delivered_;
        video_.note(frame, settings::rowOf(state_.encoding.codec).frames_depend);
        if (!refined(frame)) {
            plain_ = frame;
        }
        picture_ = std::move(frame);
        // In a room, whose refined pictures are for its best link.
        audience_.tellFrame(*picture_, audience_.several() && plainSuffices(), mail);
        updateGrant();
    });
}

void LiveSession::refuse(Error error, SessionState refused, std::optional<SessionState> drawn) {
    underLock(mutex_, [&](Mail& mail) {
        // A newer state is on its way to the stream and will be tried in its turn.
        if (state_.version != refused.version) {
            return;
        }
        const bool last = !drawn && refused.settings == first_.settings;
        audience_.tellRefusal(error, refused.applied, room_.controller(), last, {}, mail);
        if (last) {
            audience_.tellAll(
                mail, Closing{protocol::CloseCode::kNoPicture, "the first picture cannot be made"});
        } else {
            takeBack(refused, drawn, Clock::now(), mail);
            audience_.tellState(mail);
        }
    });
}

// To what was drawn last; a client may have changed much before its first picture.
void LiveSession::takeBack(const SessionState& refused,
                           const std::optional<SessionState>& drawn,
                           TimePoint now,
                           Mail& mail) {
    const SessionState good = drawn ? *drawn : first_;
    const settings::Lights& lights = good.settings.lights;
    const bool other_scene = good.scene != state_.scene;
    state_.light_clock = state_.light_clock.withRate(now, lights.speed, lights.animate);
    if (other_scene) {
        state_.playback = good.playback;
    }
    state_.playback.follow(good.settings.animation, SessionState::secondsOf(now));
    state_.followed = good.followed;
    state_.settings = good.settings;
    state_.encoding = good.encoding;
    state_.delivery = good.delivery;
    keepDecodable();
    state_.version = refused.version + 1;
    if (other_scene) {
        state_.scene = good.scene;
        first_ = session::beginOn(good.scene, now);
        scene_.show({});
        audience_.tellScene(mail);
    }
    serving_.port->update(id_, state_, now);
}

void LiveSession::compiling(bool under_way) {
    underLock(mutex_, [&](Mail& mail) {
        compiling_ = under_way;
        audience_.tellScene(mail);
    });
}

void LiveSession::deviceLost(Error error) {
    underLock(mutex_, [&](Mail& mail) {
        audience_.tellAll(mail, Rejection{RejectCode::kDevice, 0, "", error.message});
        audience_.tellAll(mail, Closing{protocol::CloseCode::kDeviceLost, "the device was lost"});
    });
}

} // namespace froxel::net
