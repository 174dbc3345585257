#include "session/room.h"

#include <gtest/gtest.h>

#include <random>

namespace froxel::session {
namespace {

Room roomOf(std::initializer_list<MemberId> members) {
    Room room("hall");
    for (const MemberId member : members) {
        room.add(member, "viewer");
    }
    return room;
}

TEST(RoomName, LettersDigitsAndThreeSigns_UpToTheCap) {
    for (const char* good : {"a", "Hall-2", "x.y_z", "0"}) {
        EXPECT_TRUE(isRoomName(good)) << good;
    }
    EXPECT_TRUE(isRoomName(std::string(64, 'r')));
    EXPECT_FALSE(isRoomName(std::string(65, 'r')));
    for (const char* bad : {"", " ", "a b", "../x", "a/b", "h\xC3\xA4", "a\n", "<b>"}) {
        EXPECT_FALSE(isRoomName(bad)) << bad;
    }
    EXPECT_FALSE(isRoomName(std::string_view("a\0b", 3)));
}

TEST(Room, Heir_IsWhoAskedLongestAndIsHere) {
    Room room = roomOf({1, 2, 3});
    EXPECT_EQ(room.heir(), 0U);
    room.requestControl(2);
    room.requestControl(3);
    EXPECT_EQ(room.heir(), 2U);
    room.setAway(2, true);
    EXPECT_EQ(room.heir(), 3U);
    room.setAway(3, true);
    EXPECT_EQ(room.heir(), 0U);
}

TEST(Room, FirstMember_Controls_OthersDoNot) {
    const Room room = roomOf({1, 2});
    EXPECT_EQ(room.controller(), 1U);
    EXPECT_TRUE(room.mayControl(1));
    const auto refused = room.mayControl(2);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, RejectCode::kControl);
    EXPECT_NE(refused.error().message.find("viewer 1 controls room hall"), std::string::npos)
        << refused.error().message;
}

TEST(Room, Request_Held_WaitsUntilReleased_InOrder) {
    Room room = roomOf({1, 2, 3});
    room.requestControl(3);
    room.requestControl(2);
    room.requestControl(3);
    EXPECT_EQ(room.controller(), 1U);
    EXPECT_EQ(room.asking(), (std::vector<MemberId>{3, 2}));
    room.releaseControl(1);
    EXPECT_EQ(room.controller(), 3U);
    EXPECT_EQ(room.asking(), (std::vector<MemberId>{2}));
}

TEST(Room, Release_NobodyAsks_IsFreeAndTakenByTheNextWhoAsks) {
    Room room = roomOf({1, 2});
    room.releaseControl(1);
    EXPECT_EQ(room.controller(), 0U);
    EXPECT_NE(room.mayControl(1).error().message.find("nobody"), std::string::npos);
    room.requestControl(2);
    EXPECT_EQ(room.controller(), 2U);
}

TEST(Room, Release_ByOneWhoAsks_TakesTheRequestBack) {
    Room room = roomOf({1, 2});
    room.requestControl(2);
    room.releaseControl(2);
    EXPECT_TRUE(room.asking().empty());
    room.releaseControl(1);
    EXPECT_EQ(room.controller(), 0U);
}

TEST(Room, Give_ByTheController_HandsItOver_ByOthersNot) {
    Room room = roomOf({1, 2, 3});
    room.requestControl(3);
    EXPECT_EQ(room.giveControl(2, 2).error().code, RejectCode::kControl);
    EXPECT_TRUE(room.giveControl(1, 3));
    EXPECT_EQ(room.controller(), 3U);
    EXPECT_TRUE(room.asking().empty());
    const auto unknown = room.giveControl(3, 9);
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, RejectCode::kOutOfRange);
    EXPECT_EQ(unknown.error().field, "member_id");
    room.setAway(2, true);
    EXPECT_FALSE(room.giveControl(3, 2)) << "nobody would be there to use it";
    EXPECT_EQ(room.controller(), 3U);
}

TEST(Room, ControllerAway_KeepsControl_UntilRemoved) {
    Room room = roomOf({1, 2});
    room.requestControl(2);
    room.setAway(1, true);
    EXPECT_EQ(room.controller(), 1U);
    room.setAway(1, false);
    EXPECT_EQ(room.controller(), 1U);
    room.setAway(1, true);
    room.remove(1);
    EXPECT_EQ(room.controller(), 2U);
}

TEST(Room, ControlFreeWhileTheAskingOneIsAway_GoesToItOnReturn) {
    Room room = roomOf({1, 2});
    room.requestControl(2);
    room.setAway(2, true);
    room.remove(1);
    EXPECT_EQ(room.controller(), 0U);
    room.setAway(2, false);
    EXPECT_EQ(room.controller(), 2U);
}

TEST(Room, Version_GrowsWithChangesOnly) {
    Room room = roomOf({1, 2});
    const uint64_t before = room.version();
    room.requestControl(1);
    room.setAway(2, false);
    room.releaseControl(2);
    room.remove(7);
    EXPECT_EQ(room.version(), before);
    room.requestControl(2);
    EXPECT_GT(room.version(), before);
}

// Whatever is done in whatever order: one controller at most, a member, who does not ask as well.
TEST(Room, AnyOrderOfCalls_KeepsItsRules) {
    std::mt19937 random(1);
    const auto draw = [&](uint32_t count) { return random() % count; };
    for (int run = 0; run < 50; ++run) {
        Room room("r");
        for (int step = 0; step < 200; ++step) {
            const MemberId id = 1 + draw(5);
            switch (draw(6)) {
            case 0:
                if (room.find(id) == nullptr) {
                    room.add(id, "");
                }
                break;
            case 1:
                room.remove(id);
                break;
            case 2:
                room.requestControl(id);
                break;
            case 3:
                room.releaseControl(id);
                break;
            case 4:
                static_cast<void>(room.giveControl(id, 1 + draw(5)));
                break;
            default:
                room.setAway(id, draw(2) == 0);
            }
            const MemberId controller = room.controller();
            ASSERT_TRUE(controller == 0 || room.find(controller) != nullptr);
            for (const MemberId asking : room.asking()) {
                ASSERT_NE(room.find(asking), nullptr);
                ASSERT_NE(asking, controller);
                ASSERT_TRUE(controller != 0 || room.find(asking)->away);
            }
        }
    }
}

} // namespace
} // namespace froxel::session
