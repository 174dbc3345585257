// Who shares a session, who waits for a place, and what each is told. No sockets, no threads.
#include "froxel/v1/server.pb.h"
#include "unit/net/lobby_fixture.h"

namespace froxel::net {
namespace {

TEST_F(LobbyTest, NoRoom_EveryoneHasASessionOfTheirOwn) {
    const Guest first = enter();
    const Guest second = enter();
    EXPECT_NE(first.seat.session->id(), second.seat.session->id());
    EXPECT_NE(first.seat.resume_token, second.seat.resume_token);
    EXPECT_TRUE(apply(first, exposure(2)));
    EXPECT_TRUE(second.ear->notices.empty());
    EXPECT_EQ(control(first, session::RequestControl{}).error().code, RejectCode::kUnsupported);
}

TEST_F(LobbyTest, Room_IsOneSession_DrawnForWhoHasMostRoom_AndToldToAllByTheSameBytes) {
    const Guest quick = enter("hall");
    const Guest slow = enter("hall");
    ASSERT_EQ(port_.sessions.size(), 1U);
    grant(quick, 3);
    grant(slow, 2);
    EXPECT_EQ(port_.session().granted, 3U);
    port_.deliver(1, now_);
    port_.deliver(2, now_);
    port_.deliver(3, now_);
    grant(quick, 6);
    EXPECT_EQ(port_.session().granted, 6U) << "the slow one is no hindrance";
    ASSERT_EQ(slow.ear->count<session::ReadyFrame>(), 3U) << "its slot keeps the newest";
    EXPECT_EQ(quick.ear->last<session::ReadyFrame>()->bytes,
              slow.ear->last<session::ReadyFrame>()->bytes);
    grant(quick, 3);
    EXPECT_EQ(port_.session().granted, 3U) << "nobody has room";
    grant(slow, 4);
    EXPECT_EQ(port_.session().granted, 4U);
}

TEST_F(LobbyTest, SessionCount_HasARoomOnce_AndWhoIsWaitedFor) {
    EXPECT_EQ(lobby_.sessionCount(), 0U);
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    const Guest alone = enter();
    EXPECT_EQ(lobby_.sessionCount(), 2U);
    leave(first);
    lose(alone);
    EXPECT_EQ(lobby_.sessionCount(), 2U);
    leave(second);
    EXPECT_EQ(lobby_.sessionCount(), 1U);
    now_ += 11s;
    lobby_.expire(now_);
    EXPECT_EQ(lobby_.sessionCount(), 0U);
}

TEST_F(LobbyTest, Watcher_SettingState_IsRefusedAndToldWhoControls) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    const auto refused = apply(second, exposure(3, 17));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, RejectCode::kControl);
    EXPECT_EQ(refused.error().ref_seq, 17U);
    EXPECT_EQ(port_.session().states.size(), 1U);
    EXPECT_TRUE(apply(first, exposure(3)));
    EXPECT_EQ(second.ear->count<StateNews>(), 1U);
    EXPECT_EQ(first.ear->count<StateNews>(), 0U) << "its own answer tells it";
}

TEST_F(LobbyTest, News_NotAskedAfterYet_AreToldOnce) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(control(second, session::RequestControl{}));
        ASSERT_TRUE(control(second, session::ReleaseControl{}));
        ASSERT_TRUE(apply(first, exposure(2 + static_cast<float>(i))));
    }
    EXPECT_EQ(first.ear->count<RoomNews>(), 1U);
    EXPECT_EQ(second.ear->count<StateNews>(), 1U);
    static_cast<void>(room(first));
    static_cast<void>(second.seat.session->newState(second.seat.place));
    ASSERT_TRUE(control(second, session::RequestControl{}));
    ASSERT_TRUE(apply(first, exposure(2)));
    EXPECT_EQ(first.ear->count<RoomNews>(), 2U);
    EXPECT_EQ(second.ear->count<StateNews>(), 2U);
}

TEST_F(LobbyTest, Control_IsAskedForGivenAndReleased_AndEveryoneIsTold) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    EXPECT_EQ(first.ear->count<RoomNews>(), 1U);
    static_cast<void>(room(first));
    ASSERT_TRUE(control(second, session::RequestControl{}));
    EXPECT_EQ(first.ear->count<RoomNews>(), 2U);
    v1::RoomState told = room(first);
    EXPECT_EQ(told.controller(), told.you());
    EXPECT_EQ(told.member_count(), 2U);
    ASSERT_EQ(told.members_size(), 2);
    EXPECT_TRUE(told.members(1).asking());
    EXPECT_EQ(told.members(1).name(), "guest");
    ASSERT_TRUE(control(first, session::GiveControl{told.members(1).id()}));
    told = room(second);
    EXPECT_EQ(told.controller(), told.you());
    EXPECT_TRUE(apply(second, exposure(3)));
    EXPECT_FALSE(apply(first, exposure(4)));
    ASSERT_TRUE(control(second, session::ReleaseControl{}));
    EXPECT_EQ(room(first).controller(), 0U);
    ASSERT_TRUE(control(first, session::RequestControl{}));
    EXPECT_TRUE(apply(first, exposure(4)));
}

TEST_F(LobbyTest, RoomOfMany_ListsThirtyTwoAndCountsAll) {
    std::vector<Guest> guests;
    for (int i = 0; i < 50; ++i) {
        guests.push_back(enter("hall"));
    }
    ASSERT_TRUE(control(guests[40], session::RequestControl{}));
    const v1::RoomState told = room(guests[49]);
    EXPECT_EQ(told.member_count(), 50U);
    ASSERT_EQ(told.members_size(), 32);
    EXPECT_EQ(told.members(0).id(), told.controller());
    EXPECT_EQ(told.members(1).id(), guests[40].seat.place.member);
    EXPECT_EQ(told.members(2).id(), guests[1].seat.place.member);
}

TEST_F(LobbyTest, Room_LastOneLeaves_EndsAndANewOneStartsAfresh) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    ASSERT_TRUE(apply(first, exposure(3)));
    leave(first);
    EXPECT_FALSE(port_.session().left);
    EXPECT_EQ(room(second).controller(), 0U);
    leave(second);
    EXPECT_TRUE(port_.session().left);
    const Guest third = enter("hall");
    EXPECT_EQ(third.seat.session->state().settings.exposure, 1);
    EXPECT_EQ(room(third).controller(), third.seat.place.member);
}

TEST_F(LobbyTest, Lost_WithinTheGrace_ComesBackWithStateClockAndPicture) {
    Guest guest = enter();
    ASSERT_TRUE(apply(guest, exposure(3)));
    grant(guest, 5);
    port_.deliver(1, now_);
    const auto before = guest.seat.session->state();
    lose(guest);
    ASSERT_EQ(alarms_, std::vector<TimePoint>{now_ + 10s});
    EXPECT_EQ(port_.session().granted, 1U) << "nothing is drawn for nobody";
    now_ += 9s;
    lobby_.expire(now_);
    EXPECT_EQ(alarms_.back(), now_ + 1s);
    alarms_.clear();
    const Guest back = enter("", guest.seat.resume_token);
    EXPECT_TRUE(back.seat.resumed);
    EXPECT_NE(back.seat.resume_token, guest.seat.resume_token);
    EXPECT_EQ(back.seat.session, guest.seat.session);
    EXPECT_EQ(back.seat.session->state().settings.exposure, 3);
    EXPECT_EQ(back.seat.session->state().light_clock.secondsAt(now_),
              before.light_clock.secondsAt(now_));
    ASSERT_TRUE(back.seat.picture);
    grant(back, 2);
    EXPECT_EQ(port_.session().granted, 3U);
    lobby_.expire(now_ + 1h);
    EXPECT_TRUE(alarms_.empty()) << "nobody is waited for";
    EXPECT_FALSE(port_.session().left);
}

TEST_F(LobbyTest, Lost_BeyondTheGrace_IsANewSessionThatSaysSo) {
    const Guest guest = enter();
    ASSERT_TRUE(apply(guest, exposure(3)));
    lose(guest);
    now_ += 10s;
    lobby_.expire(now_);
    EXPECT_TRUE(port_.session().left);
    const Guest back = enter("", guest.seat.resume_token);
    EXPECT_FALSE(back.seat.resumed);
    EXPECT_NE(back.seat.resume_token, guest.seat.resume_token);
    EXPECT_EQ(back.seat.session->state().settings.exposure, 1);
}

TEST_F(LobbyTest, UnknownTokens_AreNewSessions) {
    const Guest guest = enter();
    for (std::string token : {std::string("x"), std::string(64, '0'), guest.seat.resume_token + "0",
                              guest.seat.resume_token.substr(1), std::string("\0", 1)}) {
        EXPECT_FALSE(enter("", token).seat.resumed);
    }
    EXPECT_EQ(guest.ear->count<Closing>(), 0U);
}

TEST_F(LobbyTest, Token_OfAnotherRoom_IsNotTaken) {
    const Guest guest = enter("hall");
    EXPECT_FALSE(enter("cellar", guest.seat.resume_token).seat.resumed);
    EXPECT_TRUE(enter("hall", guest.seat.resume_token).seat.resumed);
    EXPECT_TRUE(enter("", guest.seat.resume_token).seat.resumed) << "the token knows the room";
}

TEST_F(LobbyTest, NewestConnection_Wins_AndTheOlderHasNoEffectAnyMore) {
    const Guest older = enter();
    const Guest newer = enter("", older.seat.resume_token);
    ASSERT_TRUE(newer.seat.resumed);
    ASSERT_EQ(older.ear->count<Closing>(), 1U);
    EXPECT_EQ(older.ear->last<Closing>()->code, protocol::CloseCode::kReplaced);
    grant(older, 100);
    EXPECT_EQ(port_.session().granted, 0U);
    EXPECT_TRUE(apply(older, exposure(3)));
    EXPECT_EQ(port_.session().states.size(), 1U);
    port_.deliver(1, now_);
    EXPECT_EQ(older.ear->count<session::ReadyFrame>(), 0U);
    leave(older);
    EXPECT_FALSE(port_.session().left);
    EXPECT_TRUE(apply(newer, exposure(3)));
}

// Whoever has read a token once must not take the session at any later time.
TEST_F(LobbyTest, Token_IsGoodOnce_ButAWelcomeMayBeLost) {
    const Guest first = enter();
    lose(first);
    const Guest second = enter("", first.seat.resume_token);
    ASSERT_TRUE(second.seat.resumed);
    lose(second); // before it heard of its token
    const Guest third = enter("", first.seat.resume_token);
    ASSERT_TRUE(third.seat.resumed);
    lobby_.settle(third.seat);
    EXPECT_FALSE(enter("", first.seat.resume_token).seat.resumed) << "replayed";
    EXPECT_FALSE(enter("", second.seat.resume_token).seat.resumed);
    EXPECT_EQ(third.ear->count<Closing>(), 0U);
    EXPECT_TRUE(enter("", third.seat.resume_token).seat.resumed);
}

TEST_F(LobbyTest, ControllerLost_KeepsControlForTheGrace_ThenItGoesToWhoAsked) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    lose(first);
    EXPECT_TRUE(room(second).members(0).away());
    ASSERT_TRUE(control(second, session::RequestControl{}));
    EXPECT_FALSE(apply(second, exposure(3)));
    const Guest back = enter("hall", first.seat.resume_token);
    EXPECT_EQ(room(back).controller(), room(back).you());
    EXPECT_TRUE(apply(back, exposure(3)));
    lose(back);
    now_ += 10s;
    lobby_.expire(now_);
    EXPECT_EQ(room(second).member_count(), 1U);
    EXPECT_TRUE(apply(second, exposure(4)));
}

TEST_F(LobbyTest, GraceOfZero_KeepsNothingAndGivesNoToken) {
    Lobby strict({});
    auto seat = strict.enter(serving_, {1, 0, "", "", ""}, {}, {}, now_).value();
    EXPECT_EQ(seat.resume_token, "");
    strict.depart(seat, Departure::kLost, now_);
    EXPECT_TRUE(port_.session().left);
    EXPECT_EQ(strict.awayCount(), 0U);
}

TEST_F(LobbyTest, FloodOfLostConnections_IsKeptUpToACap) {
    const Guest here = enter("hall");
    for (size_t i = 0; i < Lobby::kMaxAway + 50; ++i) {
        lose(enter("hall"));
    }
    EXPECT_EQ(lobby_.awayCount(), Lobby::kMaxAway);
    EXPECT_EQ(room(here).member_count(), Lobby::kMaxAway + 1);
    now_ += 10s;
    lobby_.expire(now_);
    EXPECT_EQ(lobby_.awayCount(), 0U);
    EXPECT_EQ(room(here).member_count(), 1U);
}

TEST_F(LobbyTest, Close_EndsWhatIsWaitedFor_AndWaitsForNobodyAfter) {
    const Guest away = enter();
    const Guest here = enter();
    lose(away);
    lobby_.close();
    EXPECT_TRUE(port_.session(7).left);
    EXPECT_FALSE(port_.session(8).left);
    lose(here);
    EXPECT_TRUE(port_.session(8).left);
    EXPECT_FALSE(enter("", here.seat.resume_token).seat.resumed);
}

TEST_F(LobbyTest, Full_IsRefused_ButRoomsAndReturnsNeedNoPlace) {
    const Guest first = enter("hall");
    const Guest own = enter();
    lose(own);
    port_.full = true;
    EXPECT_EQ(tryEnter().error().code, protocol::CloseCode::kDeviceBusy);
    EXPECT_EQ(tryEnter("cellar").error().code, protocol::CloseCode::kDeviceBusy);
    EXPECT_TRUE(tryEnter("hall"));
    EXPECT_TRUE(tryEnter("", own.seat.resume_token));
    port_.full = false;
    EXPECT_TRUE(tryEnter("cellar")) << "a refused room leaves nothing behind";
}

TEST_F(LobbyTest, Refused_InARoom_IsToldToItsSenderAlone_AndAllGetTheGoodState) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    const session::SessionState good = port_.session().states.back();
    ASSERT_TRUE(apply(first, exposure(3, 9)));
    port_.sink()->refuse({ErrorCode::kUnsupported, "no"}, port_.session().states.back(), good);
    EXPECT_EQ(first.ear->last<session::Rejection>()->ref_seq, 9U);
    EXPECT_EQ(second.ear->count<session::Rejection>(), 0U);
    EXPECT_EQ(second.seat.session->newState(second.seat.place).settings.exposure, 1);
    EXPECT_EQ(second.ear->count<StateNews>(), 1U) << "both at once";
    EXPECT_EQ(first.ear->count<StateNews>(), 1U);
}

TEST_F(LobbyTest, Refused_AgainAndAgain_IsOnePieceOfNewsToWhoOnlyWatches) {
    const Guest hostile = enter("hall");
    const Guest watcher = enter("hall");
    const session::SessionState good = port_.session().states.back();
    for (int i = 0; i < 200; ++i) {
        ASSERT_TRUE(apply(hostile, exposure(3)));
        port_.sink()->refuse({ErrorCode::kCapacity, "no"}, port_.session().states.back(), good);
    }
    EXPECT_EQ(watcher.ear->notices.size(), 1U);
    EXPECT_EQ(hostile.ear->count<session::Rejection>(), 200U);
}

TEST_F(LobbyTest, Refused_WhoAskedIsGone_IsToldToWhoHasControl) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    const session::SessionState good = port_.session().states.back();
    ASSERT_TRUE(apply(first, exposure(3, 9)));
    ASSERT_TRUE(control(second, session::RequestControl{}));
    leave(first);
    port_.sink()->refuse({ErrorCode::kCapacity, "no"}, port_.session().states.back(), good);
    EXPECT_EQ(second.ear->last<session::Rejection>()->ref_seq, 0U);
}

TEST_F(LobbyTest, Refused_FirstPictureOfARoom_IsToldToAll) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    port_.sink()->refuse({ErrorCode::kCapacity, "no"}, port_.session().states.back(), {});
    for (const Guest* guest : {&first, &second}) {
        EXPECT_EQ(guest->ear->count<session::Rejection>(), 1U);
        EXPECT_EQ(guest->ear->last<Closing>()->code, protocol::CloseCode::kNoPicture);
    }
}

TEST_F(LobbyTest, Welcome_TellsPlaceTokenAndDefaults) {
    const Guest first = enter("hall");
    ASSERT_TRUE(apply(first, exposure(3)));
    const Guest second = enter("hall");
    session::WelcomePlace place{second.seat.resume_token, 10s, true, nullptr, 0, nullptr};
    settings::PlacedLights placed;
    const auto told =
        second.seat.session->welcome(second.seat.place.member, place, placed).welcome();
    EXPECT_EQ(told.resume_token(), second.seat.resume_token);
    EXPECT_EQ(told.resume_grace_ms(), 10'000U);
    EXPECT_TRUE(told.resumed());
    EXPECT_EQ(told.room().room(), "hall");
    EXPECT_EQ(told.room().you(), second.seat.place.member);
    EXPECT_EQ(told.state().exposure(), 3);
    EXPECT_EQ(told.defaults().exposure(), 1);
    const Guest own = enter();
    const auto plain = own.seat.session->welcome(own.seat.place.member, {}, placed).welcome();
    EXPECT_FALSE(plain.has_room());
    EXPECT_FALSE(plain.has_defaults());
    EXPECT_FALSE(plain.resumed());
}

TEST_F(LobbyTest, DeviceLost_IsToldToAll) {
    const Guest first = enter("hall");
    const Guest second = enter("hall");
    port_.sink()->deviceLost({ErrorCode::kDevice, "gone"});
    for (const Guest* guest : {&first, &second}) {
        EXPECT_EQ(guest->ear->last<session::Rejection>()->code, RejectCode::kDevice);
        EXPECT_EQ(guest->ear->last<Closing>()->code, protocol::CloseCode::kDeviceLost);
    }
}

} // namespace
} // namespace froxel::net
