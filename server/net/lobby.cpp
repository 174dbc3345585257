#include "net/lobby.h"

#include "core/text.h"
#include "core/unguessable.h"
#include "session/resume_token.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace froxel::net {

using protocol::CloseCode;

namespace {

// RFC 6455 section 5.5.
constexpr size_t kReasonBytes = 123;

} // namespace

PlaceResult<Seat> Lobby::enter(const Serving& serving,
                               const session::Hello& hello,
                               const Caller& caller,
                               std::weak_ptr<SessionViewer> viewer,
                               TimePoint now) {
    return underLock(mutex_, [&](Mail& mail) -> PlaceResult<Seat> {
        auto entry = findToken(hello);
        const bool resumed = entry != entries_.end();
        if (!resumed) {
            auto added = addMember(serving, hello, caller, now, mail);
            if (!added) {
                return added.error();
            }
            entry = *added;
        } else {
            entry->second.token_before = hello.resume_token;
            entry->second.token = session::makeResumeToken();
        }
        entry->second.connection = ++last_connection_;
        entry->second.away_until.reset();
        if (rules_.forget.count() > 0) {
            alarm_(now + std::chrono::duration_cast<Clock::duration>(rules_.forget));
        }
        const Place place{entry->first, last_connection_};
        auto picture =
            entry->second.session->attach(place, std::move(viewer), hello.codecs, now, mail);
        return Seat{entry->second.session, place, entry->second.token, resumed, std::move(picture)};
    });
}

// Every token is compared to its end, so that the time says nothing about which one was near.
Lobby::Entries::iterator Lobby::findToken(const session::Hello& hello) {
    auto found = entries_.end();
    if (hello.resume_token.empty()) {
        return found;
    }
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        const bool same = sameSecret(entry->second.token, hello.resume_token);
        const bool before = sameSecret(entry->second.token_before, hello.resume_token);
        if ((same || before) && (hello.room.empty() || hello.room == entry->second.room)) {
            found = entry;
        }
    }
    return found;
}

PlaceResult<Lobby::Entries::iterator> Lobby::addMember(const Serving& serving,
                                                       const session::Hello& hello,
                                                       const Caller& caller,
                                                       TimePoint now,
                                                       Mail& mail) {
    const auto known = rooms_.find(hello.room);
    std::shared_ptr<LiveSession> session = known == rooms_.end() ? nullptr : known->second;
    if (session) {
        if (auto taken = roomTakes(hello.room, caller); !taken) {
            return taken.error();
        }
    } else {
        const auto gives_way = whoGivesWay(serving, caller, now);
        if (!gives_way) {
            return gives_way.error();
        }
        if (*gives_way) {
            end(**gives_way, {protocol::CloseCode::kResting, "another viewer took the place"},
                mail);
        }
        auto opened = LiveSession::open(serving, hello.room, caller, now);
        if (!opened) {
            return whyNot(opened.error(), now);
        }
        session = *opened;
    }
    const bool keep = rules_.resume_grace.count() > 0 && !closed_;
    Entry entry{
        session, hello.room, caller.address, keep ? session::makeResumeToken() : std::string(), "",
        0,       {}};
    session->addMember(++last_member_, hello.client_name, mail);
    if (!hello.room.empty()) {
        rooms_[hello.room] = session;
    }
    if (std::ranges::find(sessions_, session) == sessions_.end()) {
        sessions_.push_back(session);
    }
    return entries_.emplace(last_member_, std::move(entry)).first;
}

PlaceResult<void> Lobby::admits(const Serving& serving,
                                const Announcement& announcement,
                                const Caller& caller,
                                TimePoint now) const {
    const std::lock_guard lock(mutex_);
    const auto returns = [&announcement](const auto& entry) {
        return !announcement.resume.empty() &&
               (session::resumeName(entry.second.token) == announcement.resume ||
                session::resumeName(entry.second.token_before) == announcement.resume);
    };
    if (std::any_of(entries_.begin(), entries_.end(), returns)) {
        return {};
    }
    if (!announcement.resume.empty()) { // a proxy may know the server that has it
        return Closing{CloseCode::kAllTaken, "this server does not have this session"};
    }
    if (rooms_.count(announcement.room) > 0) {
        return roomTakes(announcement.room, caller);
    }
    const auto gives_way = whoGivesWay(serving, caller, now);
    return gives_way ? PlaceResult<void>() : gives_way.error();
}

PlaceResult<std::shared_ptr<LiveSession>>
Lobby::whoGivesWay(const Serving& serving, const Caller& caller, TimePoint now) const {
    if (auto allowed = withinLimits(caller); !allowed) {
        return allowed.error();
    }
    if (auto fits = serving.port->admits(caller.account(), now); !fits) {
        return whyNot(fits.error(), now);
    }
    if (rules_.sessions_max == 0 || sessions_.size() < rules_.sessions_max) {
        return nullptr;
    }
    std::shared_ptr<LiveSession> longest;
    TimePoint since = now;
    for (const auto& session : sessions_) {
        if (const TimePoint until = session->watchedUntil(rules_.rest); until <= since) {
            since = until;
            longest = session;
        }
    }
    if (!longest) {
        return Closing{CloseCode::kAllTaken,
                       "all " + numberText(rules_.sessions_max) +
                           " sessions of this server are in use; try again later"};
    }
    return longest;
}

Closing Lobby::whyNot(const Error& error, TimePoint now) const {
    if (error.code != ErrorCode::kCapacity) {
        return {CloseCode::kDeviceLost, error.message.substr(0, kReasonBytes)};
    }
    if (busy_lines_.take(now)) {
        spdlog::info("event=device_busy reason={}", logValue(error.message));
    }
    return {CloseCode::kDeviceBusy, "the server cannot draw for more viewers now; try again later"};
}

PlaceResult<void> Lobby::withinLimits(const Caller& caller) const {
    const auto check = [this](const std::string& of, uint32_t limit, const auto& counts) {
        if (limit == 0 || std::ranges::count_if(sessions_, counts) < int64_t{limit}) {
            return PlaceResult<void>();
        }
        return PlaceResult<void>(Closing{
            CloseCode::kShareTaken, of + " has " + numberText(limit) +
                                        " sessions here, which is the maximum; close one first"});
    };
    if (caller.token) {
        auto allowed = check("this token", rules_.sessions_per_token, [&](const auto& session) {
            return session->opener().token == caller.token;
        });
        if (!allowed) {
            return allowed;
        }
    }
    return check("this address", caller.local ? 0 : rules_.sessions_per_address,
                 [&](const auto& session) { return session->opener().address == caller.address; });
}

PlaceResult<void> Lobby::roomTakes(const std::string& room, const Caller& caller) const {
    int64_t all = 0;
    int64_t from_there = 0;
    for (const auto& [member, entry] : entries_) {
        if (entry.room == room) {
            ++all;
            from_there += entry.address == caller.address ? 1 : 0;
        }
    }
    const auto full = [](uint32_t limit, int64_t count) { return limit > 0 && count >= limit; };
    if (full(rules_.viewers_per_room, all)) {
        return Closing{CloseCode::kRoomFull,
                       "all " + numberText(rules_.viewers_per_room) +
                           " places of this room are in use; try again later"};
    }
    const uint32_t share = rules_.viewers_per_room_and_address;
    if (!caller.local && full(share, from_there)) {
        return Closing{CloseCode::kShareTaken,
                       "this address has " + numberText(share) +
                           " viewers in this room, which is the maximum; close one first"};
    }
    return {};
}

void Lobby::end(const LiveSession& session, const Closing& closing, Mail& mail) {
    session.tellClosing(closing, mail);
    for (auto entry = entries_.begin(); entry != entries_.end();) {
        entry = entry->second.session.get() == &session ? remove(entry, mail) : std::next(entry);
    }
}

bool Lobby::takeControl(const std::string& room) {
    return underLock(mutex_, [&](Mail& mail) -> bool {
        const auto found = rooms_.find(room);
        if (found != rooms_.end()) {
            found->second->takeControl(mail);
        }
        return found != rooms_.end();
    });
}

void Lobby::settle(const Seat& seat) {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(seat.place.member);
    if (entry != entries_.end() && entry->second.connection == seat.place.connection) {
        entry->second.token_before.clear();
    }
}

void Lobby::depart(const Seat& seat, Departure how, TimePoint now) {
    underLock(mutex_, [&](Mail& mail) {
        const auto entry = entries_.find(seat.place.member);
        if (entry == entries_.end() || entry->second.connection != seat.place.connection) {
            return; // a newer connection has the place
        }
        const bool keep = how == Departure::kLost && !entry->second.token.empty() && !closed_;
        if (!keep || countAway() >= kMaxAway) {
            remove(entry, mail);
            return;
        }
        entry->second.away_until = now + rules_.resume_grace;
        entry->second.session->detach(seat.place, mail);
        alarm_(*entry->second.away_until);
    });
}

Lobby::Entries::iterator Lobby::remove(Entries::iterator entry, Mail& mail) {
    if (entry->second.session->removeMember(entry->first, mail)) {
        std::erase(sessions_, entry->second.session);
        rooms_.erase(entry->second.room);
    }
    const auto next = entries_.erase(entry);
    if (entries_.empty()) {
        emptied_.notify_all();
    }
    return next;
}

void Lobby::passIdleControl(LiveSession& session, TimePoint now) {
    if (rules_.control_idle.count() == 0) {
        return;
    }
    Mail mail;
    if (const auto due = session.passIdleControl(rules_.control_idle, now, mail)) {
        alarm_(*due);
    }
}

void Lobby::expire(TimePoint now) {
    underLock(mutex_, [&](Mail& mail) {
        std::optional<TimePoint> next;
        const auto isNext = [&next](TimePoint due) { next = next ? std::min(*next, due) : due; };
        for (auto entry = entries_.begin(); entry != entries_.end();) {
            const auto& until = entry->second.away_until;
            if (until && *until <= now) {
                entry = remove(entry, mail);
                continue;
            }
            if (until) {
                isNext(*until);
            }
            ++entry;
        }
        for (const auto& session : std::vector(sessions_)) { // some may end
            const TimePoint forgotten = session->watchedUntil({rules_.forget, rules_.forget});
            if (rules_.forget.count() > 0 && forgotten <= now) {
                end(*session, {protocol::CloseCode::kResting, "nobody watches"}, mail);
                continue;
            }
            if (rules_.forget.count() > 0 && forgotten != TimePoint::max()) {
                isNext(forgotten);
            }
            if (rules_.control_idle.count() > 0) {
                if (const auto due = session->passIdleControl(rules_.control_idle, now, mail)) {
                    isNext(*due);
                }
            }
        }
        if (next) {
            alarm_(*next);
        }
    });
}

void Lobby::close() {
    underLock(mutex_, [&](Mail& mail) {
        closed_ = true;
        for (auto entry = entries_.begin(); entry != entries_.end();) {
            entry = entry->second.away_until ? remove(entry, mail) : std::next(entry);
        }
    });
}

bool Lobby::waitUntilEmpty(TimePoint deadline) const {
    std::unique_lock lock(mutex_);
    return emptied_.wait_until(lock, deadline, [this] { return entries_.empty(); });
}

size_t Lobby::awayCount() const {
    const std::lock_guard lock(mutex_);
    return countAway();
}

size_t Lobby::sessionCount() const {
    const std::lock_guard lock(mutex_);
    return sessions_.size();
}

size_t Lobby::countAway() const {
    return static_cast<size_t>(
        std::count_if(entries_.begin(), entries_.end(),
                      [](const auto& entry) { return entry.second.away_until.has_value(); }));
}

} // namespace froxel::net
