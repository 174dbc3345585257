// Who gets a place, who gives way, and whom control is passed on to.
#include "session/resume_token.h"
#include "unit/net/lobby_fixture.h"

namespace froxel::net {
namespace {

Caller from(const std::string& address) {
    return {{address}, false, {}};
}

class PlacesTest : public LobbyTest {
  protected:
    PlacesTest() {
        rules_.resume_grace = 10s;
        rules_.sessions_max = 4;
    }
    // The rules as they are now.
    void open() {
        strict_.emplace(rules_);
        strict_->setAlarm([this](TimePoint due) { alarms_.push_back(due); });
    }
    PlaceResult<Guest> come(const Caller& caller = from("192.0.2.1"),
                            const std::string& room = "") {
        Guest guest;
        auto seat = strict_->enter(serving_, {1, 0, "guest", room, ""}, caller, guest.ear, now_);
        if (!seat) {
            return seat.error();
        }
        guest.seat = std::move(*seat);
        return guest;
    }
    bool mayCome(const Announcement& announcement = {}, const Caller& caller = from("192.0.2.1")) {
        return strict_->admits(serving_, announcement, caller, now_).has_value();
    }
    void pause(const Guest& guest) { guest.seat.session->setPaused(guest.seat.place, true, now_); }
    void ack(const Guest& guest, uint64_t frame) {
        guest.seat.session->noteAck(guest.seat.place, frame, now_);
    }
    static bool sentAway(const Guest& guest) {
        const Closing* closing = guest.ear->last<Closing>();
        return closing != nullptr && closing->code == protocol::CloseCode::kResting;
    }

    LobbyRules rules_;
    std::optional<Lobby> strict_;
};

TEST_F(PlacesTest, AllWatch_NewcomerIsRefused) {
    open();
    std::vector<Guest> guests;
    for (int i = 0; i < 4; ++i) {
        guests.push_back(come().value());
    }
    EXPECT_EQ(come().error().code, protocol::CloseCode::kAllTaken);
    EXPECT_NE(come().error().reason.find("all 4 sessions"), std::string::npos);
    EXPECT_FALSE(mayCome());
    strict_->depart(guests[0].seat, Departure::kLeft, now_);
    EXPECT_TRUE(mayCome());
    EXPECT_TRUE(come());
}

TEST_F(PlacesTest, PausedOnes_GiveWay_TheLongestFirst_AfterTheStatedTime) {
    open();
    std::vector<Guest> guests;
    for (int i = 0; i < 4; ++i) {
        guests.push_back(come().value());
    }
    pause(guests[2]);
    now_ += 10s;
    pause(guests[1]);
    now_ += 19s;
    EXPECT_FALSE(come()) << "29 s";
    now_ += 1s;
    EXPECT_TRUE(mayCome());
    EXPECT_FALSE(sentAway(guests[2])) << "asking sends nobody away";
    EXPECT_TRUE(come());
    EXPECT_TRUE(sentAway(guests[2]));
    EXPECT_TRUE(port_.session(guests[2].seat.session->id()).left);
    EXPECT_FALSE(come());
    now_ += 10s;
    EXPECT_TRUE(come());
    EXPECT_TRUE(sentAway(guests[1]));
    EXPECT_FALSE(sentAway(guests[0]));
    EXPECT_EQ(strict_->sessionCount(), 4U);
}

TEST_F(PlacesTest, PausingAgainAndAgain_IsNoSignOfWatching) {
    rules_.sessions_max = 1;
    open();
    const Guest guest = come().value();
    pause(guest);
    now_ += 29s;
    pause(guest);
    now_ += 1s;
    EXPECT_TRUE(come());
}

TEST_F(PlacesTest, WhoAcknowledgesNoPicture_GivesWay) {
    rules_.sessions_max = 1;
    open();
    const Guest guest = come().value();
    grant(guest, 2);
    port_.deliver(1, now_);
    now_ += 29s;
    ack(guest, 1);
    port_.deliver(2, now_);
    now_ += 29s;
    EXPECT_FALSE(come());
    now_ += 1s;
    EXPECT_TRUE(come());
    EXPECT_TRUE(sentAway(guest));
}

TEST_F(PlacesTest, WatcherOfAPictureThatStands_KeepsThePlaceForLonger) {
    rules_.sessions_max = 1;
    open();
    const Guest guest = come().value();
    now_ += 200s;
    ASSERT_TRUE(apply(guest, exposure(2)));
    now_ += 299s;
    EXPECT_FALSE(come());
    now_ += 1s;
    EXPECT_TRUE(come());
    EXPECT_TRUE(sentAway(guest));
}

TEST_F(PlacesTest, Room_RestsWhenAllOfItsViewersDo) {
    rules_.sessions_max = 1;
    open();
    const Guest first = come(from("192.0.2.1"), "hall").value();
    const Guest second = come(from("192.0.2.1"), "hall").value();
    pause(first);
    now_ += 31s;
    EXPECT_FALSE(come());
    pause(second);
    now_ += 30s;
    EXPECT_TRUE(come());
    EXPECT_TRUE(sentAway(first) && sentAway(second));
    EXPECT_FALSE(mayCome({"hall", ""})) << "it is gone";
}

TEST_F(PlacesTest, DeviceIsBusy_SendsNobodyAway) {
    open();
    const Guest guest = come().value();
    pause(guest);
    now_ += 1min;
    port_.full = true;
    EXPECT_FALSE(come());
    EXPECT_FALSE(mayCome());
    EXPECT_FALSE(sentAway(guest));
}

TEST_F(PlacesTest, OneAddress_HasItsShare_AndOthersTheRest) {
    rules_.sessions_per_address = 2;
    open();
    const Guest first = come(from("192.0.2.66")).value();
    ASSERT_TRUE(come(from("192.0.2.66"), "hall"));
    const auto refused = come(from("192.0.2.66"));
    EXPECT_EQ(refused.error().code, protocol::CloseCode::kShareTaken);
    EXPECT_NE(refused.error().reason.find("this address has 2 sessions"), std::string::npos);
    EXPECT_FALSE(mayCome({}, from("192.0.2.66")));
    EXPECT_TRUE(come(from("192.0.2.66"), "hall")) << "a room needs no place";
    EXPECT_TRUE(come(from("192.0.2.7")));
    strict_->depart(first.seat, Departure::kLeft, now_);
    EXPECT_TRUE(come(from("192.0.2.66")));
}

TEST_F(PlacesTest, Room_TakesSoManyViewers_AndThoseWhoComeBack) {
    rules_.viewers_per_room = 2;
    open();
    ASSERT_TRUE(come(from("192.0.2.1"), "hall"));
    const Guest second = come(from("192.0.2.2"), "hall").value();
    strict_->depart(second.seat, Departure::kLost, now_);
    EXPECT_EQ(come(from("192.0.2.3"), "hall").error().reason,
              "all 2 places of this room are in use; try again later");
    EXPECT_FALSE(mayCome({"hall", ""}, from("192.0.2.3")));
    EXPECT_TRUE(come(from("192.0.2.3"), "cellar"));
    EXPECT_TRUE(
        strict_->enter(serving_, {1, 0, "", "hall", second.seat.resume_token}, {}, {}, now_));
}

TEST_F(PlacesTest, OneAddress_HasItsShareOfARoom_AndOthersTheRest) {
    rules_.viewers_per_room = 4;
    rules_.viewers_per_room_and_address = 2;
    open();
    ASSERT_TRUE(come(from("192.0.2.66"), "hall"));
    const Guest last = come(from("192.0.2.66"), "hall").value();
    const auto refused = come(from("192.0.2.66"), "hall");
    EXPECT_EQ(refused.error().code, protocol::CloseCode::kShareTaken);
    EXPECT_NE(refused.error().reason.find("this address has 2 viewers in this room"),
              std::string::npos);
    EXPECT_FALSE(mayCome({"hall", ""}, from("192.0.2.66")));
    EXPECT_TRUE(come(from("192.0.2.7"), "hall"));
    strict_->depart(last.seat, Departure::kLeft, now_);
    EXPECT_TRUE(mayCome({"hall", ""}, from("192.0.2.66")));
}

TEST_F(PlacesTest, LocalProxy_HasNoShareOfARoom) {
    rules_.viewers_per_room_and_address = 1;
    open();
    const Caller proxy{{"127.0.0.1"}, true, {}};
    EXPECT_TRUE(come(proxy, "hall"));
    EXPECT_TRUE(come(proxy, "hall"));
}

TEST_F(PlacesTest, LostConnections_CountForTheirAddress) {
    rules_.sessions_per_address = 2;
    open();
    for (int i = 0; i < 2; ++i) {
        strict_->depart(come(from("192.0.2.66"))->seat, Departure::kLost, now_);
    }
    EXPECT_FALSE(come(from("192.0.2.66")));
}

TEST_F(PlacesTest, LocalProxy_HasNoShare) {
    rules_.sessions_per_address = 1;
    open();
    const Caller proxy{{"127.0.0.1"}, true, {}};
    EXPECT_TRUE(come(proxy));
    EXPECT_TRUE(come(proxy));
}

TEST_F(PlacesTest, OneToken_HasItsShare_FromWhateverAddresses) {
    rules_.sessions_per_token = 1;
    open();
    const auto with = [](const std::string& address, const std::string& token) {
        return Caller{{address}, false, session::Account{token}};
    };
    ASSERT_TRUE(come(with("192.0.2.1", "token 1")));
    EXPECT_NE(come(with("192.0.2.2", "token 1")).error().reason.find("this token has 1"),
              std::string::npos);
    EXPECT_TRUE(come(with("192.0.2.1", "token 2")));
}

TEST_F(PlacesTest, Announced_ReturnsAreLetIn_ByTheNewNameAndTheOldOne) {
    open();
    const Guest guest = come().value();
    const std::string name(session::resumeName(guest.seat.resume_token));
    strict_->depart(guest.seat, Departure::kLost, now_);
    EXPECT_TRUE(mayCome({"", name}));
    EXPECT_FALSE(mayCome({"", "0123456789abcdef"})) << "another server may have it";
    EXPECT_TRUE(mayCome());
    ASSERT_TRUE(strict_->enter(serving_, {1, 0, "", "", guest.seat.resume_token}, {}, {}, now_));
    EXPECT_TRUE(mayCome({"", name})) << "it may not have heard of the new one";
}

TEST_F(PlacesTest, Forgotten_EndsWithoutANewcomer) {
    open();
    const Guest guest = come().value();
    pause(guest);
    ASSERT_FALSE(alarms_.empty());
    now_ += 59min;
    strict_->expire(now_);
    EXPECT_FALSE(sentAway(guest));
    EXPECT_EQ(alarms_.back(), now_ + 1min);
    now_ += 1min;
    strict_->expire(now_);
    EXPECT_TRUE(sentAway(guest));
    EXPECT_EQ(strict_->sessionCount(), 0U);
}

TEST_F(PlacesTest, ControlThatRests_GoesToWhoAsks) {
    open();
    const Guest first = come(from("192.0.2.1"), "hall").value();
    const Guest second = come(from("192.0.2.1"), "hall").value();
    now_ += 30s;
    ASSERT_TRUE(apply(first, exposure(2)));
    now_ += 10s;
    ASSERT_TRUE(control(second, session::RequestControl{}));
    strict_->expire(now_);
    EXPECT_FALSE(apply(second, exposure(3))) << "it was used 10 s ago";
    ASSERT_EQ(alarms_.back(), now_ + 50s);
    now_ += 50s;
    strict_->expire(now_);
    EXPECT_TRUE(apply(second, exposure(3)));
    EXPECT_FALSE(apply(first, exposure(4)));
    ASSERT_TRUE(control(first, session::RequestControl{}));
    strict_->expire(now_);
    EXPECT_FALSE(apply(first, exposure(4))) << "who got it has as much time";
}

TEST_F(PlacesTest, ControlThatRests_AskedFor_IsLookedAtInThatRoomAlone) {
    open();
    const Guest first = come(from("192.0.2.1"), "hall").value();
    const Guest second = come(from("192.0.2.1"), "hall").value();
    const Guest forgotten = come().value();
    now_ += 30s;
    ASSERT_TRUE(apply(first, exposure(2)));
    now_ += 2h;
    ASSERT_TRUE(control(second, session::RequestControl{}));
    strict_->passIdleControl(*second.seat.session, now_);
    EXPECT_TRUE(apply(second, exposure(3)));
    EXPECT_FALSE(sentAway(forgotten)) << "that is expire()'s";
    ASSERT_TRUE(control(first, session::RequestControl{}));
    strict_->passIdleControl(*first.seat.session, now_);
    EXPECT_EQ(alarms_.back(), now_ + 1min);
}

TEST_F(PlacesTest, ControlThatRests_StaysWhileNobodyAsks) {
    open();
    const Guest first = come(from("192.0.2.1"), "hall").value();
    const Guest second = come(from("192.0.2.1"), "hall").value();
    now_ += 10min;
    strict_->expire(now_);
    EXPECT_TRUE(apply(first, exposure(2)));
}

TEST_F(PlacesTest, Operator_TakesControl) {
    open();
    const Guest first = come(from("192.0.2.1"), "hall").value();
    const Guest second = come(from("192.0.2.1"), "hall").value();
    EXPECT_FALSE(strict_->takeControl("cellar"));
    EXPECT_TRUE(strict_->takeControl("hall"));
    EXPECT_EQ(room(first).controller(), 0U);
    ASSERT_TRUE(control(second, session::RequestControl{}));
    EXPECT_TRUE(apply(second, exposure(2)));
    ASSERT_TRUE(control(first, session::RequestControl{}));
    EXPECT_TRUE(strict_->takeControl("hall"));
    EXPECT_EQ(room(first).controller(), room(first).you()) << "it asked";
}

} // namespace
} // namespace froxel::net
