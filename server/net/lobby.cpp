#include "net/lobby.h"

#include "session/resume_token.h"

#include <algorithm>
#include <set>
#include <utility>

namespace froxel::net {

Result<Seat> Lobby::enter(const Serving& serving,
                          const session::Hello& hello,
                          const Caller& caller,
                          std::weak_ptr<SessionViewer> viewer,
                          TimePoint now) {
    Mail mail;
    const std::lock_guard lock(mutex_);
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
    const Place place{entry->first, last_connection_};
    auto picture = entry->second.session->attach(place, std::move(viewer), hello.codecs, now, mail);
    return Seat{entry->second.session, place, entry->second.token, resumed, std::move(picture)};
}

// Every token is compared to its end, so that the time says nothing about which one was near.
Lobby::Entries::iterator Lobby::findToken(const session::Hello& hello) {
    auto found = entries_.end();
    if (hello.resume_token.empty()) {
        return found;
    }
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        const bool same = session::sameToken(entry->second.token, hello.resume_token);
        const bool before = session::sameToken(entry->second.token_before, hello.resume_token);
        if ((same || before) && (hello.room.empty() || hello.room == entry->second.room)) {
            found = entry;
        }
    }
    return found;
}

Result<Lobby::Entries::iterator> Lobby::addMember(const Serving& serving,
                                                  const session::Hello& hello,
                                                  const Caller& caller,
                                                  TimePoint now,
                                                  Mail& mail) {
    const auto known = rooms_.find(hello.room);
    std::shared_ptr<LiveSession> session = known == rooms_.end() ? nullptr : known->second;
    if (!session) {
        auto opened = LiveSession::open(serving, hello.room, caller.account, now);
        if (!opened) {
            return opened.error();
        }
        session = *opened;
    }
    const bool keep = grace_.count() > 0 && !closed_;
    Entry entry{session, hello.room, keep ? session::makeResumeToken() : std::string(), "", 0, {}};
    session->addMember(++last_member_, hello.client_name, mail);
    if (!hello.room.empty()) {
        rooms_[hello.room] = session;
    }
    return entries_.emplace(last_member_, std::move(entry)).first;
}

void Lobby::settle(const Seat& seat) {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(seat.place.member);
    if (entry != entries_.end() && entry->second.connection == seat.place.connection) {
        entry->second.token_before.clear();
    }
}

void Lobby::depart(const Seat& seat, Departure how, TimePoint now) {
    Mail mail;
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(seat.place.member);
    if (entry == entries_.end() || entry->second.connection != seat.place.connection) {
        return; // a newer connection has the place
    }
    const bool keep = how == Departure::kLost && !entry->second.token.empty() && !closed_;
    if (!keep || countAway() >= kMaxAway) {
        remove(entry, mail);
        return;
    }
    entry->second.away_until = now + grace_;
    entry->second.session->detach(seat.place, mail);
    alarm_(*entry->second.away_until);
}

Lobby::Entries::iterator Lobby::remove(Entries::iterator entry, Mail& mail) {
    if (entry->second.session->removeMember(entry->first, mail)) {
        rooms_.erase(entry->second.room);
    }
    const auto next = entries_.erase(entry);
    if (entries_.empty()) {
        emptied_.notify_all();
    }
    return next;
}

std::optional<TimePoint> Lobby::expire(TimePoint now) {
    Mail mail;
    const std::lock_guard lock(mutex_);
    std::optional<TimePoint> next;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
        const auto& until = entry->second.away_until;
        if (until && *until <= now) {
            entry = remove(entry, mail);
            continue;
        }
        if (until && (!next || *until < *next)) {
            next = until;
        }
        ++entry;
    }
    return next;
}

void Lobby::close() {
    Mail mail;
    const std::lock_guard lock(mutex_);
    closed_ = true;
    for (auto entry = entries_.begin(); entry != entries_.end();) {
        entry = entry->second.away_until ? remove(entry, mail) : std::next(entry);
    }
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
    std::set<const LiveSession*> sessions;
    for (const auto& [member, entry] : entries_) {
        sessions.insert(entry.session.get());
    }
    return sessions.size();
}

size_t Lobby::countAway() const {
    return static_cast<size_t>(
        std::count_if(entries_.begin(), entries_.end(),
                      [](const auto& entry) { return entry.second.away_until.has_value(); }));
}

} // namespace froxel::net
