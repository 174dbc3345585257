// One session of the stream, and the viewers that it is shown to: one of its own, or those of a
// room. It is drawn and encoded once; every viewer gets the same bytes. It draws while any viewer
// has room, and each has its own window and slot, so that a slow one takes fewer pictures and slows
// nobody. Any thread; a lock inside is held for moments, never while a viewer is told something.
#pragma once

#include "net/audience.h"
#include "net/caller.h"
#include "net/lobby_rules.h"
#include "net/mail.h"
#include "net/scene_wish.h"
#include "net/service.h"
#include "net/video_need.h"
#include "session/room.h"
#include "session/state_message.h"

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace froxel::net {

class LiveSession final : public session::FrameSink,
                          public session::SceneWaiter,
                          public std::enable_shared_from_this<LiveSession> {
  public:
    // Joins the stream; `room` is empty for a session of one's own. Charged to who opens it.
    // Errors: StreamPort::join's.
    [[nodiscard]] static Result<std::shared_ptr<LiveSession>>
    open(const Serving& serving, std::string room, Caller opener, TimePoint now);
    ~LiveSession() override;
    LiveSession(const LiveSession&) = delete;
    LiveSession& operator=(const LiveSession&) = delete;

    // The places' keeper calls these, under its own lock; so it posts their mail.
    void addMember(session::MemberId member, std::string name, Mail& mail);
    // The member's connection from now on, which decodes `codecs`; an older one is told to close.
    // Gives the newest picture, if the client decodes it by itself. Before a refined one the plain
    // one if that is as asked for: the refined one follows when the link is known to carry it.
    [[nodiscard]] std::optional<session::ReadyFrame> attach(const Place& place,
                                                            std::weak_ptr<SessionViewer> viewer,
                                                            settings::CodecSet codecs,
                                                            TimePoint now,
                                                            Mail& mail);
    // The connection is gone, and the member waited for.
    void detach(const Place& place, Mail& mail);
    // For good; whether nobody is left, upon which the stream's session has ended.
    [[nodiscard]] bool removeMember(session::MemberId member, Mail& mail);

    // A command that sets state. Refused: session::apply's, and kControl.
    [[nodiscard]] session::CommandResult<void>
    apply(const Place& place, const session::CommandMessage& message, TimePoint now);
    // SelectScene: what is shown stays until the scene is there. Refused: kControl, kOutOfRange
    // where there is no such scene.
    [[nodiscard]] session::CommandResult<void>
    selectScene(const Place& place, const session::CommandMessage& message, TimePoint now);
    // For a viewer that SceneNews came to: the scene and its state where that is another than it
    // knows of, and how far one is that is being loaded. `placed` becomes the placed lights that
    // are told of.
    [[nodiscard]] std::vector<v1::ServerMessage> newsOfScene(const Place& place,
                                                             settings::PlacedLights& placed);
    // RequestControl, ReleaseControl or GiveControl. Refused: outside a room, and Room's.
    [[nodiscard]] session::CommandResult<void> changeControl(const Place& place,
                                                             const session::Command& command);
    // Control that was not used for `limit` goes to who asks for it. When that is next, none: as
    // long as nobody asks anew.
    std::optional<TimePoint> passIdleControl(Seconds limit, TimePoint now, Mail& mail);
    // Control goes from whoever has it to who has asked longest, or becomes free.
    void takeControl(Mail& mail);
    // Key frames that viewers get at once, and a second: each costs all of them some pictures'
    // bits.
    static constexpr double kKeysAtOnce = 3;
    static constexpr double kKeysPerSecond = 1;
    // The viewer can go on with video only from a key frame; nothing while there is no video. Those
    // who ask before it is there share one. Too early: not done, and when to ask again.
    [[nodiscard]] std::optional<TimePoint> requestKeyFrame(const Place& place, TimePoint now);
    // As StreamPort::grant, in pictures that this connection was told of.
    void grant(const Place& place, uint64_t frame_total);
    // What this connection's link allows, from its first acknowledgement on. The session is
    // delivered as to its best one that is not paused: a slow viewer takes fewer pictures, and
    // lowers nobody's.
    void setDelivery(const Place& place, const session::Delivery& delivery);
    void setPaused(const Place& place, bool paused, TimePoint now);
    // Whether this connection wants depth with its pictures.
    void setWantsDepth(const Place& place, bool wants, TimePoint now);
    [[nodiscard]] bool offersDepth() const { return serving_.offers_depth; }
    // The viewer acknowledged a picture: it watches.
    void noteAck(const Place& place, uint64_t frame_id, TimePoint now);
    // Until when its viewers count as watching, unless they give another sign of it: an hour hence,
    // say, while one that does nothing watches a picture that stands.
    [[nodiscard]] TimePoint watchedUntil(const RestLimits& limits) const;
    void tellClosing(const Closing& closing, Mail& mail) const;
    // How far below what was asked for its pictures are made now, see Delivery.
    [[nodiscard]] uint32_t deliveredRung() const;

    [[nodiscard]] session::SessionId id() const { return id_; }
    [[nodiscard]] const Caller& opener() const { return opener_; } // whom it is charged to
    [[nodiscard]] session::SessionState state() const;
    // The same, for a viewer that StateNews came to.
    [[nodiscard]] session::SessionState newState(const Place& place);
    [[nodiscard]] bool controls(const Place& place) const;
    [[nodiscard]] v1::ServerMessage roomState(session::MemberId you);
    // `resumed` and the token are the caller's; `placed` becomes the placed lights that it tells
    // of.
    [[nodiscard]] v1::ServerMessage welcome(session::MemberId you,
                                            session::WelcomePlace place,
                                            settings::PlacedLights& placed) const;

    void deliver(session::ReadyFrame frame) override;
    void refuse(Error error,
                session::SessionState refused,
                std::optional<session::SessionState> drawn) override;
    void compiling(bool under_way) override;
    void deviceLost(Error error) override;
    void onSceneProgress(const std::string& id, const Progress& progress) override;
    void onScene(const std::string& id, Result<session::SharedContext> scene) override;

  private:
    LiveSession(Serving serving, std::string room, Caller opener, TimePoint now);
    void callOff();
    void show(const session::SharedContext& scene,
              const session::CommandStamp& stamp,
              TimePoint now,
              Mail& mail);
    [[nodiscard]] bool plainSuffices() const;
    void updateGrant();
    void updateCodecs(TimePoint now, Mail& mail);
    void updateDepth(TimePoint now);
    void keepDecodable();
    void updateDelivery();
    void takeBack(const session::SessionState& refused,
                  const std::optional<session::SessionState>& drawn,
                  TimePoint now,
                  Mail& mail);

    const Serving serving_;
    const Caller opener_;
    session::SessionId id_ = 0;

    mutable std::mutex mutex_;
    session::Room room_;
    session::MemberId used_by_ = 0; // the controller, as far as is known
    TimePoint control_used_{};      // when it last set state, or got control
    Audience audience_;
    session::SessionState first_; // of a session on this scene
    session::SessionState state_;
    SceneWish scene_;
    bool compiling_ = false;                     // shaders of the next picture
    std::optional<session::ReadyFrame> picture_; // newest
    std::optional<session::ReadyFrame> plain_;   // newest that is not refined
    uint64_t delivered_ = 0;                     // pictures that came from the stream
    uint64_t granted_ = 0;
    VideoNeed video_{kKeysAtOnce, kKeysPerSecond};
    session::Delivery delivery_; // as the stream knows it
    bool takes_frames_ = true;   // likewise
    bool ended_ = false;
};

} // namespace froxel::net
