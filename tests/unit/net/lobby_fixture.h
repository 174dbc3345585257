// A lobby with a fake stream, and guests who keep what they are told.
#pragma once

#include "froxel/v1/server.pb.h"
#include "net/lobby.h"
#include "support/fake_port.h"
#include "support/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace froxel::net {

using namespace std::chrono_literals;
using session::RejectCode;

// A connection that keeps what it is told.
struct Ear final : SessionViewer {
    void tell(Notice notice) override { notices.push_back(std::move(notice)); }

    template <class Kind>
    [[nodiscard]] size_t count() const {
        return static_cast<size_t>(std::count_if(notices.begin(), notices.end(), [](const auto& n) {
            return std::holds_alternative<Kind>(n);
        }));
    }
    template <class Kind>
    [[nodiscard]] const Kind* last() const {
        for (auto notice = notices.rbegin(); notice != notices.rend(); ++notice) {
            if (const auto* found = std::get_if<Kind>(&*notice)) {
                return found;
            }
        }
        return nullptr;
    }

    std::vector<Notice> notices;
};

struct Guest {
    std::shared_ptr<Ear> ear = std::make_shared<Ear>();
    Seat seat;
};

inline session::CommandMessage exposure(float value, uint64_t seq = 2) {
    return {{seq, 0}, test::settings({{"exposure", static_cast<double>(value)}})};
}

class LobbyTest : public testing::Test {
  protected:
    PlaceResult<Guest> tryEnter(const std::string& room = "", const std::string& token = "") {
        Guest guest;
        auto seat = lobby_.enter(serving_, {1, 0, "guest", room, token}, caller_, guest.ear, now_);
        if (!seat) {
            return seat.error();
        }
        guest.seat = std::move(*seat);
        return guest;
    }
    Guest enter(const std::string& room = "", const std::string& token = "") {
        return tryEnter(room, token).value();
    }
    void lose(const Guest& guest) { lobby_.depart(guest.seat, Departure::kLost, now_); }
    void leave(const Guest& guest) { lobby_.depart(guest.seat, Departure::kLeft, now_); }
    static v1::RoomState room(const Guest& guest) {
        return guest.seat.session->roomState(guest.seat.place.member).room_state();
    }
    auto apply(const Guest& guest, const session::CommandMessage& message) {
        return guest.seat.session->apply(guest.seat.place, message, now_);
    }
    static void grant(const Guest& guest, uint64_t total) {
        guest.seat.session->grant(guest.seat.place, total);
    }
    template <class Command>
    static auto control(const Guest& guest, Command command) {
        return guest.seat.session->changeControl(guest.seat.place, command);
    }

    test::FakePort port_;
    Serving serving_{std::make_shared<const session::SessionContext>(), &port_};
    TimePoint now_ = TimePoint() + 1h;
    Caller caller_{{"192.0.2.7"}, false, {}};
    std::vector<TimePoint> alarms_;
    Lobby lobby_{LobbyRules{.resume_grace = 10s, .forget = 0s}};

    LobbyTest() {
        lobby_.setAlarm([this](TimePoint due) { alarms_.push_back(due); });
    }
};

} // namespace froxel::net
