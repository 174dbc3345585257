#include "render_loop_fixture.h"
#include "scene/scene.h"
#include "stream/scene_host.h"

#include <atomic>
#include <condition_variable>
#include <gmock/gmock.h>
#include <mutex>

namespace froxel::stream {
namespace {

using session::SharedContext;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A session that keeps what it hears.
class Waiter final : public session::SceneWaiter {
  public:
    void onSceneProgress(const std::string& /*id*/, const Progress& progress) override {
        const std::lock_guard lock(mutex_);
        fractions_.push_back(progress.fraction);
    }
    void onScene(const std::string& /*id*/, Result<SharedContext> scene) override {
        const std::lock_guard lock(mutex_);
        outcome_ = std::move(scene);
        heard_.notify_all();
    }
    // Null where nothing came within 10 s.
    [[nodiscard]] std::optional<Result<SharedContext>> outcome() {
        std::unique_lock lock(mutex_);
        heard_.wait_for(lock, std::chrono::seconds(10), [this] { return outcome_.has_value(); });
        return std::exchange(outcome_, std::nullopt);
    }
    [[nodiscard]] bool heard() {
        const std::lock_guard lock(mutex_);
        return outcome_.has_value();
    }
    [[nodiscard]] std::vector<double> fractions() {
        const std::lock_guard lock(mutex_);
        return fractions_;
    }

  private:
    std::mutex mutex_;
    std::condition_variable heard_;
    std::optional<Result<SharedContext>> outcome_;
    std::vector<double> fractions_;
};

// A render loop over a fake device that begins with the scene "first" and is offered "a" to "e".
class SceneHostTest : public RenderLoopTest {
  protected:
    void begin(uint64_t scene_bytes = 1000) {
        SceneHostOptions options;
        options.offers = [this](const std::string& id) -> std::optional<uint64_t> {
            const bool offered = id.size() == 1 && id >= "a" && id <= "e" && !withdrawn_;
            return offered ? std::optional(version_.load()) : std::nullopt;
        };
        options.read = [this](const std::string& id,
                              const ProgressReport& report) -> Result<ReadScene> {
            ++begun_reads_;
            if (!passReading(id, report)) {
                ++called_off_;
                while (linger_) {
                    std::this_thread::yield();
                }
                return Error{ErrorCode::kCancelled, id};
            }
            ++read_count_;
            read_ids_ += id;
            if (id == "e") {
                return Error{ErrorCode::kScene, "e.glb is no glTF"};
            }
            auto scene = std::make_shared<scene::Scene>();
            scene->name = id;
            session::SessionContext context;
            context.scene.name = id;
            context.scene.triangle_count = 12;
            return ReadScene{std::move(scene), std::move(context)};
        };
        options.turn = turn_;
        options.most_reading = most_reading_;
        host_ = std::make_shared<SceneHost>(std::move(options));
        RenderLoopOptions loop;
        loop.min_frame_interval = Seconds(0);
        loop.fates = fates_;
        loop.scenes = host_;
        loop.make_source = [this, scene_bytes] {
            auto source = test::makeFakeSource(device_);
            session::SessionContext context;
            context.scene_id = "first";
            first_ = std::make_shared<const session::SessionContext>(std::move(context));
            host_->begin(*source, first_, version_, scene_bytes, [this] { loop_->wake(); });
            begun_.set_value();
            return source;
        };
        loop.on_failure = [this](const Error& error) { failure_.set_value(error); };
        loop_ = std::make_unique<RenderLoop>(pool_, std::move(loop));
        begun_.get_future().wait();
    }
    ~SceneHostTest() override {
        setReading(true);
        if (loop_) {
            loop_->stop();
        }
    }
    // While closed, files are not read.
    void setReading(bool open) {
        const std::lock_guard lock(gate_mutex_);
        gate_open_ = open;
        gate_.notify_all();
    }
    bool passReading(const std::string& id, const ProgressReport& report) {
        std::unique_lock lock(gate_mutex_);
        do {
            if (!report({"reading", 0.1})) {
                return false;
            }
        } while (!gate_.wait_for(lock, std::chrono::milliseconds(1),
                                 [&] { return gate_open_ || (!slow_.empty() && id != slow_); }));
        return true;
    }
    // Null and a failure of the test where it does not come.
    SharedContext load(const std::string& id) {
        const auto waiter = std::make_shared<Waiter>();
        const auto there = host_->want(id, waiter);
        EXPECT_TRUE(there) << there.error().message;
        if (there && *there) {
            return *there;
        }
        const auto outcome = waiter->outcome();
        EXPECT_TRUE(outcome && *outcome);
        return outcome && *outcome ? **outcome : nullptr;
    }
    session::SessionState stateOn(const SharedContext& scene) {
        auto state = still();
        state.scene = scene;
        state.version = ++state_version_;
        return state;
    }
    // Until the render thread has done what it was woken for.
    template <class Condition>
    static bool comes(const Condition& condition) {
        const auto end = Clock::now() + std::chrono::seconds(10);
        while (!condition() && Clock::now() < end) {
            std::this_thread::yield();
        }
        return condition();
    }

    std::atomic<uint64_t> version_ = 1;
    std::atomic<bool> withdrawn_ = false; // nothing is offered any more
    std::atomic<int> begun_reads_ = 0;
    std::atomic<int> read_count_ = 0;
    std::atomic<int> called_off_ = 0;
    std::atomic<bool> linger_ = false; // whoever reads is slow to end
    std::string read_ids_; // in their order; the host's thread's until nothing is read any more
    std::mutex gate_mutex_;
    std::condition_variable gate_;
    bool gate_open_ = true;
    std::string slow_; // while closed, this one alone; none: all
    Seconds turn_{60};
    Seconds most_reading_{60};
    uint64_t state_version_ = 100;
    SharedContext first_;
    std::promise<void> begun_;
    std::shared_ptr<SceneHost> host_;
};

TEST_F(SceneHostTest, WantedScene_IsReadMovedAndDrawn) {
    device_->slice_count = 5;
    begin();
    const auto sink = makeSink();
    const auto id = join(sink, stateOn(first_), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    const auto waiter = std::make_shared<Waiter>();
    const auto there = host_->want("a", waiter);
    ASSERT_TRUE(there);
    EXPECT_EQ(*there, nullptr);
    const auto outcome = waiter->outcome();
    ASSERT_TRUE(outcome && *outcome);
    EXPECT_EQ((**outcome)->scene.name, "a");
    const auto fractions = waiter->fractions();
    EXPECT_TRUE(std::ranges::is_sorted(fractions));
    EXPECT_GT(fractions.size(), 3U);

    const auto before = sink->frames().size();
    loop_->update(id, stateOn(**outcome), Clock::now());
    ASSERT_TRUE(sink->waitForFrames(before + 1));
    EXPECT_THAT(device_->views(), ElementsAre("", "a"));
    EXPECT_TRUE(comes([&] { return device_->live_views == 1; }));
    loop_->update(id, stateOn(first_), Clock::now());
    ASSERT_TRUE(sink->waitForFrames(before + 2));
    EXPECT_THAT(device_->views(), ElementsAre("", "a", ""));
}

TEST_F(SceneHostTest, SceneThatIsThere_IsGivenAtOnceAndReadOnce) {
    begin();
    const SharedContext a = load("a");
    EXPECT_EQ(load("a"), a);
    EXPECT_EQ(load("first"), first_);
    EXPECT_EQ(read_count_, 1);
    EXPECT_EQ(host_->counts().resident, 2U);
}

TEST_F(SceneHostTest, TwoWhoWantTheSame_ShareOneLoad) {
    begin();
    setReading(false);
    const auto one = std::make_shared<Waiter>();
    const auto two = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", one));
    ASSERT_TRUE(host_->want("a", two));
    setReading(true);
    const auto first = one->outcome();
    const auto second = two->outcome();
    ASSERT_TRUE(first && second && *first && *second);
    EXPECT_EQ(**first, **second);
    EXPECT_EQ(read_count_, 1);
}

// What a file holds is known once it was read, also after the scene has left, until the file is
// another one.
TEST_F(SceneHostTest, Report_TellsWhatWasRead) {
    using session::SceneStanding;
    begin(900);
    EXPECT_EQ(host_->reportOf("z").standing, SceneStanding::kUnknown);
    EXPECT_EQ(host_->reportOf("first").standing, SceneStanding::kReady);
    EXPECT_EQ(host_->reportOf("a").standing, SceneStanding::kOffered);
    EXPECT_FALSE(host_->reportOf("a").contents);
    setReading(false);
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    EXPECT_TRUE(comes([&] { return host_->reportOf("a").progress.fraction > 0; }));
    EXPECT_EQ(host_->reportOf("a").standing, SceneStanding::kLoading);
    setReading(true);
    EXPECT_TRUE(comes([&] { return host_->reportOf("a").standing == SceneStanding::kReady; }));
    EXPECT_EQ(host_->reportOf("a").contents->triangles, 12U);
    EXPECT_TRUE(comes([&] { return host_->counts().loading == 0; }));
    ++version_;
    EXPECT_EQ(host_->reportOf("a").standing, SceneStanding::kOffered);
    EXPECT_FALSE(host_->reportOf("a").contents);
}

// Stills wait for those whom somebody looks at.
TEST_F(SceneHostTest, PatientWaiter_IsServedLast) {
    class Patient final : public session::SceneWaiter {
      public:
        void onSceneProgress(const std::string& /*id*/, const Progress& /*progress*/) override {}
        void onScene(const std::string& /*id*/, Result<SharedContext> /*scene*/) override {}
        [[nodiscard]] bool isPatient() const override { return true; }
    };
    begin();
    setReading(false);
    const auto patient = std::make_shared<Patient>();
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", patient)); // is being read already, or goes first as well
    EXPECT_TRUE(comes([&] { return host_->reportOf("a").progress.fraction > 0; }));
    ASSERT_TRUE(host_->want("b", patient));
    ASSERT_TRUE(host_->want("c", waiter));
    setReading(true);
    EXPECT_TRUE(comes([&] { return host_->counts().loaded_total == 3; }));
    EXPECT_EQ(read_ids_, "acb");
}

TEST_F(SceneHostTest, SlowFile_KeepsNoOtherFromBeingRead) {
    turn_ = Seconds(0.01);
    slow_ = "a";
    begin();
    setReading(false);
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    EXPECT_TRUE(load("b"));
    EXPECT_TRUE(load("c"));
    EXPECT_FALSE(waiter->heard());
    setReading(true);
    EXPECT_TRUE(waiter->outcome().value());
}

TEST_F(SceneHostTest, FileThatTakesFarTooLong_IsGivenUp) {
    most_reading_ = Seconds(0.05);
    begin();
    setReading(false);
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    const auto outcome = waiter->outcome();
    ASSERT_TRUE(outcome);
    ASSERT_FALSE(*outcome);
    EXPECT_EQ(outcome->error().code, ErrorCode::kScene);
    EXPECT_THAT(outcome->error().message, HasSubstr("did not finish"));
}

TEST_F(SceneHostTest, UnknownScene_IsRefused) {
    begin();
    const auto refused = host_->want("zz\n", std::make_shared<Waiter>());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(refused.error().message, "is \"zz\\x0a\", which is not a scene of this server");
}

TEST_F(SceneHostTest, FileThatCannotBeRead_IsToldInOneLineAndMayBeTriedAgain) {
    begin();
    for (int attempt = 0; attempt < 2; ++attempt) {
        const auto waiter = std::make_shared<Waiter>();
        ASSERT_TRUE(host_->want("e", waiter));
        const auto outcome = waiter->outcome();
        ASSERT_TRUE(outcome);
        ASSERT_FALSE(*outcome);
        EXPECT_EQ(outcome->error().message, "e.glb is no glTF");
    }
    EXPECT_EQ(host_->counts().failed_total, 2U);
    EXPECT_TRUE(load("a"));
}

TEST_F(SceneHostTest, NobodyLooksAt_LeavesForOthersOldestFirst) {
    device_->scene_bytes = 400;
    begin(1000);
    SharedContext a = load("a");
    load("b");
    load("a"); // asked for after b
    EXPECT_EQ(host_->counts().bytes, 800U);
    load("c");
    EXPECT_TRUE(comes([&] { return device_->live_scenes == 2; }));
    EXPECT_EQ(host_->counts().evicted_total, 1U);
    EXPECT_EQ(load("a"), a);
    EXPECT_EQ(read_count_, 3);
}

TEST_F(SceneHostTest, SceneOfASession_NeverLeaves) {
    device_->scene_bytes = 400;
    begin(1000);
    const auto sink = makeSink();
    const auto id = join(sink, stateOn(load("a")), kPlenty);
    ASSERT_TRUE(sink->waitForFrames(1));
    for (const char* other : {"b", "c", "d", "b", "c"}) {
        load(other);
    }
    const auto begun = device_->begun_count.load();
    loop_->update(id, stateOn(load("a")), Clock::now());
    EXPECT_TRUE(comes([&] { return device_->begun_count > begun; }));
    EXPECT_THAT(device_->views(), ElementsAre("a"));
}

TEST_F(SceneHostTest, ScenesInUseFillTheMemory_OneMoreIsRefusedWithFigures) {
    device_->scene_bytes = uint64_t{400} << 20U;
    begin(uint64_t{1000} << 20U);
    const SharedContext a = load("a");
    const SharedContext b = load("b");
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("c", waiter));
    const auto outcome = waiter->outcome();
    ASSERT_TRUE(outcome);
    ASSERT_FALSE(*outcome);
    EXPECT_EQ(outcome->error().code, ErrorCode::kCapacity);
    EXPECT_THAT(outcome->error().message,
                HasSubstr("c takes 401 MiB of the device's memory; 800 MiB of the 1000"));
    EXPECT_EQ(host_->counts().refused_total, 1U);
    EXPECT_EQ(host_->counts().resident, 3U); // none had to leave for nothing
}

TEST_F(SceneHostTest, NobodyWaitsAnyMore_IsNotLoaded) {
    begin();
    setReading(false);
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    auto gone = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("b", gone));
    host_->dismiss("a", waiter);
    gone.reset();
    setReading(true);
    EXPECT_TRUE(load("c"));
    EXPECT_FALSE(waiter->heard());
    EXPECT_EQ(host_->counts().resident, 2U);
    EXPECT_EQ(host_->counts().loading, 0U);
    EXPECT_LE(read_count_, 2); // a may have been under way
}

TEST_F(SceneHostTest, NobodyWaitsAnyMore_ReadingEnds) {
    begin();
    setReading(false);
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    ASSERT_TRUE(comes([&] { return begun_reads_ == 1; }));
    host_->dismiss("a", waiter);
    EXPECT_TRUE(comes([&] { return host_->counts().loading == 0; }));
    EXPECT_EQ(host_->counts().failed_total, 0U);
    EXPECT_FALSE(waiter->heard());
}

TEST_F(SceneHostTest, WantedAgainWhileReadingEnds_IsReadOnceMore) {
    begin();
    setReading(false);
    linger_ = true;
    const auto gone = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", gone));
    ASSERT_TRUE(comes([&] { return begun_reads_ == 1; }));
    host_->dismiss("a", gone);
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(comes([&] { return called_off_ == 1; }));
    ASSERT_TRUE(host_->want("a", waiter));
    setReading(true);
    linger_ = false;
    const auto outcome = waiter->outcome();
    ASSERT_TRUE(outcome && *outcome);
    EXPECT_EQ(begun_reads_, 2);
    EXPECT_FALSE(gone->heard());
}

TEST_F(SceneHostTest, Stop_EndsReading) {
    begin();
    setReading(false);
    ASSERT_TRUE(host_->want("a", std::make_shared<Waiter>()));
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    ASSERT_TRUE(comes([&] { return begun_reads_ == 1; }));
    loop_->stop(); // with whoever reads
    EXPECT_EQ(read_count_, 0);
}

TEST_F(SceneHostTest, DismissedOnItsWay_LeavesTheDevice) {
    device_->slice_count = UINT32_MAX;
    begin();
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    ASSERT_TRUE(comes([&] { return device_->live_moves == 1; }));
    host_->dismiss("a", waiter);
    EXPECT_TRUE(comes([&] { return device_->live_moves == 0; }));
    EXPECT_EQ(host_->counts().loading, 0U);
    EXPECT_FALSE(waiter->heard());
}

// As sessions do.
class EndingWaiter final : public session::SceneWaiter,
                           public std::enable_shared_from_this<EndingWaiter> {
  public:
    EndingWaiter(SceneHost& host, std::string id) : host_(host), id_(std::move(id)) {}
    EndingWaiter(const EndingWaiter&) = delete;
    EndingWaiter& operator=(const EndingWaiter&) = delete;
    ~EndingWaiter() override { host_.dismiss(id_, weak_from_this()); }
    void onSceneProgress(const std::string& /*id*/, const Progress& /*progress*/) override {}
    void onScene(const std::string& /*id*/, Result<SharedContext> /*scene*/) override {}

  private:
    SceneHost& host_;
    const std::string id_;
};

TEST_F(SceneHostTest, SessionsThatEndWhileTheirScenesCome_BlockNobody) {
    device_->slice_count = 50;
    device_->scene_bytes = 400;
    begin(1000);
    for (int i = 0; i < 400; ++i) {
        const std::string id(1, static_cast<char>('a' + i % 4));
        auto waiter = std::make_shared<EndingWaiter>(*host_, id);
        ASSERT_TRUE(host_->want(id, waiter));
        if (i % 3 == 0) {
            std::this_thread::yield();
        }
    }
    EXPECT_TRUE(comes([&] { return host_->counts().loading == 0; }));
    EXPECT_TRUE(load("a"));
}

TEST_F(SceneHostTest, ChangedFile_IsReadAnewAndTheOldOneStaysForWhoHasIt) {
    begin();
    const SharedContext before = load("a");
    version_ = 2;
    const SharedContext after = load("a");
    EXPECT_NE(after, before);
    EXPECT_EQ(read_count_, 2);
    EXPECT_EQ(device_->live_scenes, 2);
    EXPECT_EQ(load("a"), after);
}

TEST_F(SceneHostTest, WithdrawnScene_LeavesOnceNobodyHoldsIt) {
    begin();
    auto held = load("a");
    load("b");
    ASSERT_EQ(host_->counts().resident, 3U);
    withdrawn_ = true;
    host_->tidy();
    EXPECT_TRUE(comes([&] { return host_->counts().resident == 2; }));
    EXPECT_EQ(held->scene.name, "a");
    held.reset(); // which wakes nobody
    EXPECT_TRUE(comes([&] { return host_->counts().resident == 1; }));
    EXPECT_EQ(host_->counts().evicted_total, 0U);
}

TEST_F(SceneHostTest, Stop_EndsScenesBeforeTheirDevice) {
    begin();
    const SharedContext a = load("a");
    device_->slice_count = UINT32_MAX;
    ASSERT_TRUE(host_->want("b", std::make_shared<Waiter>()));
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("b", waiter));
    ASSERT_TRUE(comes([&] { return device_->live_moves == 1; }));
    loop_->stop();
    EXPECT_EQ(device_->live_scenes, 0);
    EXPECT_EQ(device_->live_moves, 0);
    EXPECT_EQ(device_->outlived, 0);
    EXPECT_FALSE(host_->want("a", waiter)); // nothing is loaded any more
}

TEST_F(SceneHostTest, LostDeviceWhileMoving_EndsTheLoop) {
    device_->slice_count = UINT32_MAX;
    begin();
    ASSERT_TRUE(host_->want("a", std::make_shared<Waiter>()));
    const auto waiter = std::make_shared<Waiter>();
    ASSERT_TRUE(host_->want("a", waiter));
    device_->lost = true;
    EXPECT_EQ(failure_.get_future().get().code, ErrorCode::kDevice);
}

} // namespace
} // namespace froxel::stream
