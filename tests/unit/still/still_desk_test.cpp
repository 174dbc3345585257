#include "context.h"
#include "still/still_desk.h"
#include "support/fake_port.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace froxel::still {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const TimePoint kNow = Clock::now();

// Scenes that come when a test says so.
class FakeScenes final : public session::ScenePort {
  public:
    Result<session::SharedContext>
    want(const std::string& id, const std::shared_ptr<session::SceneWaiter>& waiter) override {
        if (!id.starts_with("scene")) {
            return Error{ErrorCode::kInvalidArgument, "is no scene of this server"};
        }
        wanted.push_back(id);
        if (ready.contains(id)) {
            return contextOf(id);
        }
        waiters[id] = waiter;
        return session::SharedContext();
    }
    session::SceneCounts counts() const override { return {}; }
    session::SceneReport reportOf(const std::string& id) const override {
        using session::SceneStanding;
        return {ready.contains(id)        ? SceneStanding::kReady
                : id.starts_with("scene") ? SceneStanding::kOffered
                                          : SceneStanding::kUnknown,
                {},
                {}};
    }
    void dismiss(const std::string& id, const std::weak_ptr<session::SceneWaiter>&) override {
        waiters.erase(id);
    }
    static session::SharedContext contextOf(const std::string& id) {
        auto context = session::makeContext();
        context.scene_id = id;
        context.scene_number = 5;
        return std::make_shared<const session::SessionContext>(std::move(context));
    }
    void come(const std::string& id) { settle(id, contextOf(id)); }
    void settle(const std::string& id, Result<session::SharedContext> outcome) {
        const auto waiter = waiters.at(id).lock();
        waiters.erase(id);
        waiter->onScene(id, std::move(outcome));
    }

    std::set<std::string> ready;
    std::vector<std::string> wanted;
    std::map<std::string, std::weak_ptr<session::SceneWaiter>> waiters;
};

class StillDeskTest : public testing::Test {
  protected:
    struct Asked {
        StillDesk::Ticket ticket = 0;
        std::shared_ptr<std::optional<StillOutcome>> outcome =
            std::make_shared<std::optional<StillOutcome>>();

        [[nodiscard]] bool answered() const { return outcome->has_value(); }
        [[nodiscard]] bool drawn() const {
            return answered() && std::holds_alternative<StillPicture>(**outcome);
        }
        [[nodiscard]] const StillRefusal& refusal() const {
            return std::get<StillRefusal>(outcome->value());
        }
    };

    static std::shared_ptr<StillDesk> makeDesk(const StillLimits& limits = {}) {
        auto desk = std::make_shared<StillDesk>(limits);
        return desk;
    }
    Asked ask(const std::string& tag,
              const std::string& scene = "",
              const std::optional<session::Account>& account = session::Account{"192.0.2.7"},
              const std::string& size = "64x64") {
        Asked asked;
        StillRequest request;
        request.scene = scene;
        request.view = {{"size", size}};
        request.tag = tag;
        asked.ticket = desk_->ask(
            {first_, &port_, &scenes_}, std::move(request), account,
            [outcome = asked.outcome](StillOutcome came) {
                EXPECT_FALSE(*outcome) << "answered twice";
                *outcome = std::move(came);
            },
            kNow);
        return asked;
    }
    void deliver(uint64_t seat = 0, size_t bytes = 10) {
        port_.deliver(++last_frame_, kNow, test::FakePort::kFirstId + seat, bytes);
    }

    test::FakePort port_;
    FakeScenes scenes_;
    session::SharedContext first_ =
        std::make_shared<const session::SessionContext>(session::makeContext());
    std::shared_ptr<StillDesk> desk_ = makeDesk();
    uint64_t last_frame_ = 0;
};

TEST_F(StillDeskTest, Still_IsOnePictureOfASeat) {
    const Asked asked = ask("a");
    ASSERT_EQ(port_.sessions.size(), 1U);
    EXPECT_EQ(port_.session().granted, 1U);
    EXPECT_EQ(port_.session().states.back().settings.size, (settings::Size{64, 64}));
    EXPECT_FALSE(asked.answered());
    deliver();
    EXPECT_TRUE(asked.drawn());
    EXPECT_EQ(desk_->counts().drawn_total, 1U);
}

TEST_F(StillDeskTest, SameStill_IsDrawnOnce_ForAllWhoAsk) {
    const Asked one = ask("a");
    const Asked other = ask("a");
    deliver();
    EXPECT_TRUE(one.drawn());
    EXPECT_TRUE(other.drawn());
    EXPECT_TRUE(ask("a").drawn()) << "and given again later";
    EXPECT_EQ(port_.session().states.size(), 1U);
    EXPECT_EQ(desk_->counts().kept_total, 1U);
}

TEST_F(StillDeskTest, Seats_AreUsedAgain_AndNoMoreThanThereMayBe) {
    std::vector<Asked> asked;
    for (const char* tag : {"a", "b", "c", "d", "e"}) {
        asked.push_back(ask(tag));
    }
    EXPECT_EQ(port_.sessions.size(), 4U);
    deliver(2);
    EXPECT_TRUE(asked[2].drawn());
    EXPECT_FALSE(asked[4].answered());
    EXPECT_EQ(port_.session(test::FakePort::kFirstId + 2).granted, 2U);
    deliver(2);
    EXPECT_TRUE(asked[4].drawn());
    EXPECT_EQ(port_.sessions.size(), 4U);
}

// Its state is another one for the render thread, whatever was drawn before.
TEST_F(StillDeskTest, NextPictureOfASeat_HasAVersionOfItsOwn) {
    (void)ask("a");
    deliver();
    (void)ask("b");
    const auto& states = port_.session().states;
    ASSERT_EQ(states.size(), 2U);
    EXPECT_NE(states[0].version, states[1].version);
}

TEST_F(StillDeskTest, Refused_TellsWhatFits_AndTheSeatGoesOn) {
    const Asked asked = ask("a", "", {}, "1600x900");
    port_.sink()->refuse({ErrorCode::kCapacity, "too large", 4.0}, port_.session().states.back(),
                         {});
    EXPECT_EQ(asked.refusal().why.message, "too large");
    ASSERT_TRUE(asked.refusal().fits);
    EXPECT_LT(asked.refusal().fits->width_px, 800U);
    EXPECT_GT(asked.refusal().fits->width_px, 700U);
    const Asked next = ask("b", "", {}, "1600x900");
    EXPECT_EQ(port_.session().granted, 1U) << "the refused one took none";
    deliver();
    EXPECT_TRUE(next.drawn());
}

TEST_F(StillDeskTest, LargerThanTheServerDraws_TellsWhatFits) {
    StillRequest request;
    request.view = {{"size", "4096x4096"}, {"antialiasing", "ssaa4"}};
    std::optional<StillOutcome> outcome;
    desk_->ask(
        {first_, &port_, nullptr}, request, {},
        [&](StillOutcome came) { outcome = std::move(came); }, kNow);
    const auto& refusal = std::get<StillRefusal>(outcome.value());
    EXPECT_EQ(refusal.why.code, session::RejectCode::kCapacity);
    EXPECT_TRUE(refusal.fits);
    EXPECT_FALSE(refusal.retry_after);
}

TEST_F(StillDeskTest, OneAccount_WaitsForNine_AndOthersStillAsk) {
    for (int i = 0; i < 9; ++i) {
        EXPECT_FALSE(ask(std::to_string(i)).answered());
    }
    const Asked tenth = ask("10");
    EXPECT_EQ(tenth.refusal().why.code, session::RejectCode::kRateLimit);
    EXPECT_TRUE(tenth.refusal().retry_after);
    EXPECT_FALSE(ask("11", "", session::Account{"198.51.100.1"}).answered());
}

TEST_F(StillDeskTest, All_WaitForSixtyFour) {
    for (int i = 0; i < 64; ++i) {
        EXPECT_FALSE(ask(std::to_string(i), "", std::nullopt).answered());
    }
    EXPECT_THAT(ask("one more", "", std::nullopt).refusal().why.message,
                HasSubstr("64 stills are waiting"));
}

TEST_F(StillDeskTest, OneAccount_DrawsSoManyAMinute) {
    desk_ = makeDesk({.per_minute = 6, .at_once = 2});
    for (const char* tag : {"a", "b"}) {
        (void)ask(tag);
        deliver();
    }
    const Asked third = ask("c");
    EXPECT_THAT(third.refusal().why.message, HasSubstr("more than 6 stills a minute"));
    EXPECT_EQ(third.refusal().retry_after, 10s);
    EXPECT_TRUE(ask("a").drawn()) << "what is kept costs nothing";
    EXPECT_FALSE(ask("d", "", std::nullopt).answered()) << "this host is exempt";
}

TEST_F(StillDeskTest, OtherScene_IsLoaded_AndLetGoAfterwards) {
    const Asked asked = ask("a", "scene1");
    EXPECT_TRUE(port_.sessions.empty());
    scenes_.come("scene1");
    ASSERT_EQ(port_.sessions.size(), 1U);
    EXPECT_EQ(port_.session().states.back().scene->scene_id, "scene1");
    deliver();
    EXPECT_TRUE(asked.drawn());
    EXPECT_TRUE(port_.session().left) << "or the scene could not leave";
}

TEST_F(StillDeskTest, ScenesThatAreNotThere_ComeOneAfterAnother) {
    const Asked one = ask("a", "scene1");
    const Asked other = ask("b", "scene2");
    scenes_.ready.insert("scene3");
    (void)ask("c", "scene3");
    EXPECT_EQ(scenes_.wanted, (std::vector<std::string>{"scene1", "scene3"}));
    scenes_.come("scene1");
    EXPECT_EQ(scenes_.wanted.back(), "scene2");
    EXPECT_FALSE(one.answered());
    EXPECT_FALSE(other.answered());
}

TEST_F(StillDeskTest, TwoStillsOfAScene_WaitForItTogether) {
    (void)ask("a", "scene1");
    (void)ask("b", "scene1");
    EXPECT_EQ(scenes_.wanted.size(), 1U);
    scenes_.come("scene1");
    EXPECT_EQ(port_.sessions.size(), 2U);
}

TEST_F(StillDeskTest, SceneThatCannotBeRead_IsOneLine_AndTheNextIsLoaded) {
    const Asked broken = ask("a", "scene1");
    (void)ask("b", "scene2");
    scenes_.settle("scene1", Error{ErrorCode::kScene, "a.glb: it is broken"});
    EXPECT_EQ(broken.refusal().why.message, "a.glb: it is broken");
    EXPECT_EQ(broken.refusal().why.field, "scene");
    EXPECT_EQ(scenes_.wanted.back(), "scene2");
    EXPECT_THAT(ask("c", "nothing").refusal().why.message, HasSubstr("no scene")) << "at once";
}

TEST_F(StillDeskTest, SceneWithoutRoom_IsAskedForOnceMore) {
    const Asked asked = ask("a", "scene1");
    scenes_.settle("scene1", Error{ErrorCode::kCapacity, "no room"});
    EXPECT_FALSE(asked.answered());
    desk_->expire(Clock::now() + 1s);
    ASSERT_EQ(scenes_.wanted.size(), 2U);
    scenes_.settle("scene1", Error{ErrorCode::kCapacity, "no room"});
    EXPECT_EQ(asked.refusal().why.message, "no room");
}

TEST_F(StillDeskTest, Cancelled_IsNotDrawn_AndItsSceneNotLoaded) {
    std::vector<Asked> asked;
    for (const char* tag : {"a", "b", "c", "d", "e"}) {
        asked.push_back(ask(tag));
    }
    desk_->cancel(asked[4].ticket);
    deliver(0);
    EXPECT_EQ(port_.session().states.size(), 1U);
    const Asked of_scene = ask("s", "scene1");
    desk_->cancel(of_scene.ticket);
    EXPECT_TRUE(scenes_.waiters.empty());
    EXPECT_FALSE(of_scene.answered());
}

TEST_F(StillDeskTest, CancelledByOneOfTwo_IsDrawnForTheOther) {
    const Asked one = ask("a", "scene1");
    const Asked other = ask("a", "scene1");
    desk_->cancel(one.ticket);
    scenes_.come("scene1");
    deliver();
    EXPECT_FALSE(one.answered());
    EXPECT_TRUE(other.drawn());
}

TEST_F(StillDeskTest, TooLate_IsToldToComeBack_AndTheSeatGoesOn) {
    const Asked asked = ask("a");
    desk_->expire(kNow + 61s);
    EXPECT_TRUE(asked.refusal().retry_after);
    const Asked next = ask("b");
    port_.session().states.pop_back(); // the picture of before is delivered first
    deliver();
    EXPECT_FALSE(next.answered());
    EXPECT_EQ(port_.session().granted, 2U);
}

// Its view ends when the picture that nobody waits for is done; the scene is not held until then.
TEST_F(StillDeskTest, TooLateOfAnotherScene_LetsItGo) {
    const Asked asked = ask("a", "scene1");
    scenes_.come("scene1");
    desk_->expire(kNow + 61s);
    EXPECT_TRUE(asked.refusal().retry_after);
    EXPECT_TRUE(port_.session().left);
}

// Of 64x64: 12,288 bytes at most; the fake device's are 10.
TEST_F(StillDeskTest, OneAccount_HasSoManyBytesOnTheirWay) {
    desk_ = makeDesk({.account_bytes = 2 * 12'288 - 1});
    Asked held = ask("a");
    const Asked second = ask("b");
    EXPECT_EQ(second.refusal().why.code, session::RejectCode::kRateLimit);
    EXPECT_TRUE(second.refusal().retry_after);
    EXPECT_FALSE(ask("c", "", session::Account{"198.51.100.1"}).answered());
    deliver();
    ASSERT_TRUE(held.drawn());
    EXPECT_FALSE(ask("d").answered()) << "10 bytes are on their way";
    deliver();
    desk_ = makeDesk({.account_bytes = 12'288 + 9});
    held = ask("a");
    deliver(2);
    ASSERT_TRUE(held.drawn());
    EXPECT_TRUE(ask("a").drawn()) << "the same that is kept is small";
    EXPECT_EQ(ask("e").refusal().why.code, session::RejectCode::kRateLimit);
    held.outcome->reset();
    EXPECT_FALSE(ask("e").answered()) << "what was sent counts no more";
}

TEST_F(StillDeskTest, All_HaveSoManyBytesOnTheirWay_ButOneAloneMayBeLarger) {
    desk_ = makeDesk({.account_bytes = 12'287, .all_bytes = 12'287});
    const Asked first = ask("a");
    EXPECT_FALSE(first.answered());
    const Asked other = ask("b", "", session::Account{"198.51.100.1"});
    EXPECT_EQ(other.refusal().why.code, session::RejectCode::kCapacity);
    EXPECT_THAT(other.refusal().why.message, HasSubstr("being drawn or sent"));
    const Asked same = ask("a", "", session::Account{"198.51.100.1"});
    EXPECT_EQ(same.refusal().why.code, session::RejectCode::kCapacity);
    const Asked small = ask("c", "", session::Account{"198.51.100.1"}, "32x32");
    EXPECT_EQ(small.refusal().why.code, session::RejectCode::kCapacity) << "there is one bound";
    deliver();
    EXPECT_TRUE(first.drawn());
}

TEST_F(StillDeskTest, PictureThatCannotBeEncoded_IsRefused_AndTheSeatGoesOn) {
    const Asked asked = ask("a");
    port_.sink()->notEncoded({ErrorCode::kUnsupported, "no JPEG is as wide"});
    EXPECT_EQ(asked.refusal().why.message, "no JPEG is as wide");
    const Asked next = ask("b");
    deliver();
    EXPECT_TRUE(next.drawn());
}

TEST_F(StillDeskTest, SeatThatRests_Leaves) {
    (void)ask("a");
    deliver();
    desk_->expire(Clock::now() + 9s);
    EXPECT_FALSE(port_.session().left);
    desk_->expire(Clock::now() + 11s);
    EXPECT_TRUE(port_.session().left);
}

TEST_F(StillDeskTest, FullStream_IsToldToComeBack) {
    port_.full = true;
    EXPECT_TRUE(ask("a").refusal().retry_after);
    port_.full = false;
    (void)ask("b");
    deliver();
}

TEST_F(StillDeskTest, LostDevice_AnswersAll) {
    const Asked one = ask("a");
    const Asked other = ask("b", "scene1");
    port_.sink()->deviceLost({ErrorCode::kDevice, "the device was lost"});
    EXPECT_EQ(one.refusal().why.message, "the device was lost");
    EXPECT_TRUE(other.answered());
}

TEST_F(StillDeskTest, SceneThatDidNotComeInTime_IsDismissed) {
    const Asked asked = ask("a", "scene1");
    EXPECT_EQ(scenes_.waiters.size(), 1U);
    desk_->expire(kNow + 61s);
    EXPECT_THAT(asked.refusal().why.message, HasSubstr("was not ready in time"));
    EXPECT_TRUE(scenes_.waiters.empty()) << "its reader would go on for nobody";
}

TEST_F(StillDeskTest, SlowScene_KeepsNoOtherFromBeingAskedFor) {
    (void)ask("a", "scene1");
    (void)ask("b", "scene2");
    EXPECT_EQ(scenes_.wanted, std::vector<std::string>{"scene1"});
    desk_->expire(kNow + 6s);
    EXPECT_EQ(scenes_.wanted, (std::vector<std::string>{"scene1", "scene2"}));
}

TEST_F(StillDeskTest, Alarm_IsSetAnewForWhatIsDueLater) {
    std::vector<TimePoint> alarms;
    desk_->setAlarm([&](TimePoint due) { alarms.push_back(due); });
    (void)ask("a", "scene1");
    alarms.clear();
    desk_->expire(kNow + 10s);
    ASSERT_FALSE(alarms.empty());
    EXPECT_EQ(alarms.back(), kNow + 60s);
}

// Many who do not read must not keep others from a picture.
TEST_F(StillDeskTest, AnswersNobodyReads_GiveWayToThoseOfWhoHasFewer) {
    desk_ = makeDesk({.account_bytes = 1 << 20U, .all_bytes = 32'000});
    const Asked one = ask("a");
    deliver(0, 10'000);
    const Asked two = ask("b");
    deliver(0, 10'000);
    ASSERT_TRUE(one.drawn() && two.drawn());
    size_t closed = 0;
    for (const Asked& asked : {one, two}) {
        Unsent::sending(
            std::get<StillPicture>(asked.outcome->value()).bytes, [&] { ++closed; }, kNow - 5s);
    }
    const Asked other = ask("c", "", session::Account{"198.51.100.1"}); // 12 KiB while it is drawn
    EXPECT_FALSE(other.answered()) << "it is being drawn";
    EXPECT_EQ(closed, 1U);
}

} // namespace
} // namespace froxel::still
