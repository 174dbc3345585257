// A session that goes over to another scene.
#include "lobby_fixture.h"
#include "session/scene_port.h"

#include <gmock/gmock.h>
#include <map>

namespace froxel::net {
namespace {

using session::SharedContext;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Scenes that are there, that come when the test says so, or that there are none of.
class FakeScenes final : public session::ScenePort {
  public:
    Result<SharedContext> want(const std::string& id,
                               const std::shared_ptr<session::SceneWaiter>& waiter) override {
        if (there.contains(id)) {
            return there.at(id);
        }
        if (id == "none") {
            return Error{ErrorCode::kInvalidArgument, "is \"none\", which is no scene"};
        }
        waiters[id] = waiter;
        return SharedContext();
    }
    [[nodiscard]] session::SceneCounts counts() const override { return {}; }
    [[nodiscard]] session::SceneReport reportOf(const std::string& id) const override {
        return {there.contains(id)     ? session::SceneStanding::kReady
                : waiters.contains(id) ? session::SceneStanding::kLoading
                                       : session::SceneStanding::kOffered,
                {},
                {}};
    }
    void dismiss(const std::string& id,
                 const std::weak_ptr<session::SceneWaiter>& /*waiter*/) override {
        waiters.erase(id);
    }
    SharedContext put(const std::string& id) {
        session::SessionContext context;
        context.scene.name = id;
        context.scene_id = id;
        context.defaults.settings.exposure = 3;
        there[id] = std::make_shared<const session::SessionContext>(std::move(context));
        return there[id];
    }
    void come(const std::string& id, const Result<SharedContext>& outcome) {
        const auto waiter = waiters.at(id).lock();
        waiters.erase(id);
        waiter->onScene(id, outcome);
    }

    std::map<std::string, SharedContext> there;
    std::map<std::string, std::weak_ptr<session::SceneWaiter>> waiters;
};

class SceneSession : public LobbyTest {
  protected:
    SceneSession() {
        session::SessionContext context;
        context.scene_id = "first";
        serving_.context = std::make_shared<const session::SessionContext>(std::move(context));
        serving_.scenes = &scenes_;
    }
    auto select(const Guest& guest, const std::string& id, uint64_t seq = 9) {
        return guest.seat.session->selectScene(guest.seat.place,
                                               {{seq, 0}, session::SelectScene{id}}, now_);
    }
    static std::vector<v1::ServerMessage> news(const Guest& guest) {
        settings::PlacedLights placed;
        return guest.seat.session->newsOfScene(guest.seat.place, placed);
    }
    const session::SessionState& drawn() { return port_.session().states.back(); }

    FakeScenes scenes_;
};

TEST_F(SceneSession, SceneThatIsThere_IsShownAtOnce) {
    const SharedContext fox = scenes_.put("fox");
    const Guest guest = enter();
    ASSERT_TRUE(select(guest, "fox", 9));
    EXPECT_EQ(drawn().scene, fox);
    EXPECT_EQ(drawn().applied.seq, 9U);
    EXPECT_EQ(guest.ear->count<SceneNews>(), 1U);
    const auto messages = news(guest);
    ASSERT_THAT(messages, SizeIs(1));
    const v1::SceneChanged& changed = messages[0].scene_changed();
    EXPECT_EQ(changed.ref_seq(), 9U);
    EXPECT_EQ(changed.scene().id(), "fox");
    EXPECT_EQ(changed.scene().name(), "fox");
    EXPECT_EQ(changed.state().exposure(), 3);
    EXPECT_THAT(news(guest), IsEmpty()); // told once
}

TEST_F(SceneSession, ShadersAreCompiled_IsToldOnce_AndItsEnd) {
    const Guest guest = enter();
    port_.sink()->compiling(true);
    EXPECT_EQ(guest.ear->count<SceneNews>(), 1U);
    auto messages = news(guest);
    ASSERT_THAT(messages, SizeIs(1));
    EXPECT_EQ(messages[0].loading().stage(), "compiling shaders");
    EXPECT_THAT(news(guest), IsEmpty());
    port_.sink()->compiling(false);
    messages = news(guest);
    ASSERT_THAT(messages, SizeIs(1));
    EXPECT_EQ(messages[0].loading().stage(), "");
}

TEST_F(SceneSession, SceneThatIsLoaded_IsShownWhenItIsThere) {
    const Guest guest = enter();
    ASSERT_TRUE(select(guest, "fox"));
    EXPECT_EQ(port_.session().states.size(), 1U); // what is shown stays
    auto messages = news(guest);
    ASSERT_THAT(messages, SizeIs(1));
    EXPECT_EQ(messages[0].scene_loading().scene(), "fox");

    guest.seat.session->onSceneProgress("fox", {"reading", 0.25});
    messages = news(guest);
    ASSERT_THAT(messages, SizeIs(1));
    EXPECT_EQ(messages[0].scene_loading().stage(), "reading");
    EXPECT_EQ(messages[0].scene_loading().fraction(), 0.25);

    scenes_.come("fox", scenes_.put("fox"));
    EXPECT_EQ(drawn().scene, scenes_.there["fox"]);
    messages = news(guest);
    ASSERT_THAT(messages, SizeIs(2));
    EXPECT_EQ(messages[0].scene_changed().scene().id(), "fox");
    EXPECT_EQ(messages[1].scene_loading().scene(), "");
}

TEST_F(SceneSession, SceneThatCannotBeHad_ChangesNothingAndIsSaid) {
    const Guest guest = enter();
    ASSERT_TRUE(select(guest, "fox", 12));
    scenes_.come("fox", Error{ErrorCode::kScene, "fox.glb is no glTF"});
    EXPECT_EQ(port_.session().states.size(), 1U);
    const auto* said = guest.ear->last<session::Rejection>();
    ASSERT_NE(said, nullptr);
    EXPECT_EQ(said->ref_seq, 12U);
    EXPECT_EQ(said->field, "scene");
    EXPECT_EQ(said->message, "fox.glb is no glTF");
}

TEST_F(SceneSession, UnknownScene_IsRefused) {
    const Guest guest = enter();
    const auto refused = select(guest, "none", 5);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, RejectCode::kOutOfRange);
    EXPECT_EQ(refused.error().ref_seq, 5U);
    EXPECT_EQ(refused.error().field, "scene");
    EXPECT_TRUE(refused.error().blameless);
}

TEST_F(SceneSession, TheOneThatIsShown_CallsOffTheOneThatComes) {
    const Guest guest = enter();
    ASSERT_TRUE(select(guest, "fox"));
    (void)news(guest);
    ASSERT_TRUE(select(guest, "first"));
    EXPECT_THAT(scenes_.waiters, IsEmpty());
    const auto messages = news(guest);
    ASSERT_THAT(messages, SizeIs(1));
    EXPECT_EQ(messages[0].scene_loading().scene(), "");
}

TEST_F(SceneSession, AnotherChoice_CallsOffTheOneBefore) {
    const Guest guest = enter();
    ASSERT_TRUE(select(guest, "fox"));
    ASSERT_TRUE(select(guest, "cat"));
    EXPECT_THAT(scenes_.waiters, SizeIs(1));
    scenes_.come("cat", scenes_.put("cat"));
    EXPECT_EQ(drawn().scene->scene.name, "cat");
}

TEST_F(SceneSession, Room_IsChangedForAllByWhoControlsIt) {
    scenes_.put("fox");
    const Guest controls = enter("hall");
    const Guest watches = enter("hall");
    const auto refused = select(watches, "fox");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, RejectCode::kControl);
    ASSERT_TRUE(select(controls, "fox", 9));
    for (const Guest* guest : {&controls, &watches}) {
        const auto messages = news(*guest);
        ASSERT_THAT(messages, SizeIs(1));
        EXPECT_EQ(messages[0].scene_changed().scene().id(), "fox");
        EXPECT_EQ(messages[0].scene_changed().ref_seq(), guest == &controls ? 9U : 0U);
    }
}

TEST_F(SceneSession, WhoComesLater_IsWelcomedToTheSceneOfNow) {
    scenes_.put("fox");
    const Guest controls = enter("hall");
    port_.deliver(1, now_);
    ASSERT_TRUE(select(controls, "fox"));
    const Guest late = enter("hall");
    EXPECT_FALSE(late.seat.picture); // that one shows another scene
    settings::PlacedLights placed;
    const auto welcome = late.seat.session->welcome(late.seat.place.member, {}, placed).welcome();
    EXPECT_EQ(welcome.scene().id(), "fox");
    EXPECT_THAT(news(late), IsEmpty());
}

TEST_F(SceneSession, PictureThatCannotBeMade_GoesBackToTheSceneBefore) {
    scenes_.put("fox");
    const Guest guest = enter();
    const session::SessionState before = drawn();
    ASSERT_TRUE(select(guest, "fox"));
    (void)news(guest);
    port_.sink()->refuse({ErrorCode::kCapacity, "no memory"}, drawn(), before);
    EXPECT_EQ(drawn().scene, before.scene);
    const auto messages = news(guest);
    ASSERT_THAT(messages, SizeIs(1));
    EXPECT_EQ(messages[0].scene_changed().scene().id(), "first");
}

TEST_F(SceneSession, SessionThatEnds_CallsOffWhatComes) {
    const Guest guest = enter();
    ASSERT_TRUE(select(guest, "fox"));
    leave(guest);
    EXPECT_TRUE(scenes_.waiters.empty() || scenes_.waiters.at("fox").expired());
}

} // namespace
} // namespace froxel::net
