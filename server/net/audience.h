// The viewers of one session: their connections, what each was told, takes and decodes. Its
// session's lock covers it.
#pragma once

#include "net/lobby_rules.h"
#include "net/mail.h"
#include "session/stream_port.h"

#include <map>
#include <memory>
#include <optional>

namespace froxel::net {

// A picture above the plain quality.
[[nodiscard]] bool refined(const session::ReadyFrame& frame);
// Whether a link takes a refined picture in bearable time.
[[nodiscard]] bool carries(const session::Delivery& delivery, const session::ReadyFrame& frame);

class Audience {
  public:
    struct Member {
        uint64_t connection = 0;
        std::weak_ptr<SessionViewer> viewer; // empty while away
        uint64_t delivered = 0;              // pictures told to this connection
        uint64_t granted = 0;
        settings::CodecSet codecs = settings::CodecSet().set(); // all while away
        std::optional<session::Delivery> delivery = {};         // none: nothing acknowledged yet
        bool paused = false;
        bool wants_depth = false;
        uint64_t told_frame = 0; // the newest picture told to this connection
        uint64_t acked_frame = 0;
        TimePoint watched_at{}; // its last sign of watching
        // It was told, and has not asked since: of many changes it hears once.
        bool has_room_news = false;
        bool has_state_news = false;
        bool has_scene_news = false;
        uint64_t told_scene = 0;   // SceneWish::count() of what it knows of
        bool told_loading = false; // that one is being loaded
        bool told_compiling = false;
    };

    void add(session::MemberId member) { members_[member]; }
    void remove(session::MemberId member) { members_.erase(member); }
    // The member's connection from now on; an older one is told to close.
    Member& attach(const Place& place,
                   std::weak_ptr<SessionViewer> viewer,
                   settings::CodecSet codecs,
                   TimePoint now,
                   Mail& mail);
    // Null: a newer connection of the member has replaced it, or the member left.
    [[nodiscard]] Member* find(const Place& place);
    [[nodiscard]] bool empty() const { return members_.empty(); }
    [[nodiscard]] bool several() const { return members_.size() > 1; }

    void tellAll(Mail& mail, const Notice& notice) const;
    // Each hears once of many changes, until it asks.
    void tellRoom(Mail& mail);
    void tellState(Mail& mail, std::optional<session::MemberId> but = {});
    void tellScene(Mail& mail);
    void noteRoomTold(session::MemberId member);
    // To all, unless `may_wait`: then to those whose link carries it.
    void tellFrame(const session::ReadyFrame& frame, bool may_wait, Mail& mail);
    static void tellFrame(Member& member, const session::ReadyFrame& frame, Mail& mail);
    // Who asked is told, or who has control where that one is gone; or all.
    void tellRefusal(const Error& error,
                     const session::CommandStamp& asked,
                     std::optional<session::MemberId> controller,
                     bool to_all,
                     const std::string& field,
                     Mail& mail) const;

    // What all who are here decode.
    [[nodiscard]] settings::CodecSet decodable() const;
    // Whether any asked for it.
    [[nodiscard]] bool wantsDepth() const;
    // Pictures that the viewer with the most room takes.
    [[nodiscard]] uint64_t room() const;
    // Of the best link that is not paused; null: none was told of.
    [[nodiscard]] const session::Delivery* best() const;
    // Whether any is here and not paused.
    [[nodiscard]] bool takesFrames() const;
    // See LiveSession::watchedUntil().
    [[nodiscard]] TimePoint watchedUntil(const RestLimits& limits, const session::Room& room) const;

  private:
    std::map<session::MemberId, Member> members_;
};

} // namespace froxel::net
