// The scenes of a server: those on the device, which all sessions share that show them, and those
// on their way to it.
//
// One at a time is read, on a thread of low priority, and moved to the device in slices, between
// others' frames. A file that takes longer than a moment no longer keeps the next ones from being
// read beside it, and one that takes far too long is given up. Where memory is short, scenes leave
// that nobody holds, the one asked for longest ago first; one of which tidy() tells leaves in any
// case. The scene that the server began with stays.
#pragma once

#include "core/clock.h"
#include "session/scene_port.h"
#include "stream/frame_source.h"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace froxel::stream {

// What a scene's file gave.
struct ReadScene {
    std::shared_ptr<const scene::Scene> scene;
    session::SessionContext context;
};

struct SceneHostOptions {
    // The version of a scene that is offered by this name, another one where its file is another;
    // none: there is none. Any thread.
    std::function<std::optional<uint64_t>(const std::string& id)> offers =
        [](const std::string& /*id*/) -> std::optional<uint64_t> { return {}; };
    // Reads one; on one of the host's own threads. Errors: one line for a person; any where
    // `report` has it end early. May throw StartupError.
    std::function<Result<ReadScene>(const std::string& id, const ProgressReport& report)> read;
    // After so long the next one is read beside it ...
    Seconds turn{5};
    // ... and after so long, more than the largest scenes that were tried need, it is given up.
    Seconds most_reading{300};
};

class SceneHost final : public session::ScenePort {
  public:
    explicit SceneHost(SceneHostOptions options);
    ~SceneHost() override;
    SceneHost(const SceneHost&) = delete;
    SceneHost& operator=(const SceneHost&) = delete;

    [[nodiscard]] Result<session::SharedContext>
    want(const std::string& id, const std::shared_ptr<session::SceneWaiter>& waiter) override;
    [[nodiscard]] session::SceneCounts counts() const override;
    [[nodiscard]] session::SceneReport reportOf(const std::string& id) const override;
    void dismiss(const std::string& id, const std::weak_ptr<session::SceneWaiter>& waiter) override;

    // Render thread. The device and its first scene are there, as it was at that version. Scenes
    // beside that may take so many bytes of the device's memory together. `wake` has work() called
    // soon.
    void begin(FrameSource& device,
               session::SharedContext first,
               uint64_t first_version,
               uint64_t scene_bytes,
               std::function<void()> wake);
    // Does a slice of what is to be done; when more is to be, none: wake() tells. Throws
    // StartupError where the device was lost.
    [[nodiscard]] std::optional<TimePoint> work(TimePoint now);
    // Of the scene that a state holds; null: the first one.
    [[nodiscard]] SceneSource& sourceOf(const session::SessionContext* scene);
    // Something is not offered any more: it leaves the device once nobody holds it. Any thread.
    void tidy();
    // The device goes, and with it all that is there, which nobody draws any more.
    void end();
    // The device is lost: what it may still use is never freed.
    void lose();

  private:
    struct Resident {
        std::string id;
        uint64_t version = 0;
        session::SharedContext context;
        std::unique_ptr<SceneSource> source;
        TimePoint asked_at{};
    };
    enum class Stage : uint8_t { kQueued, kReading, kMoving };
    struct Coming {
        Stage stage = Stage::kQueued;
        std::optional<TimePoint> read_since{}; // of kReading
        uint64_t version = 0;
        std::vector<std::weak_ptr<session::SceneWaiter>> waiters; // never held under the lock
        bool patient = true;                                      // all of them
        // From kMoving on; the render thread's.
        std::unique_ptr<SceneMove> move;
        session::SharedContext context;
        uint64_t bytes = 0; // that it will take
        Progress progress{"waiting for its turn", 0};
        TimePoint begun_at{};
    };
    struct Contents {
        uint64_t version = 0;
        session::SceneContents of;
    };
    using Waiters = std::vector<std::shared_ptr<session::SceneWaiter>>;
    using Residents = std::map<uint64_t, Resident>; // by SessionContext::scene_number

    void run(const std::stop_token& stop);
    // Under the lock: the one whose turn it is, or that nobody waits for any more; end: none yet.
    [[nodiscard]] std::deque<std::string>::iterator nextToLoad(TimePoint now);
    // Of what comes, whose reading has begun.
    void load(const std::string& id);
    [[nodiscard]] bool isWanted(const std::string& id) const;
    void putAside(const std::string& id);
    [[nodiscard]] Result<void> prepare(const std::string& id, ReadScene read);
    // Under the lock: whether the first scene is what is offered by this name.
    [[nodiscard]] bool isFirst(const std::string& id, std::optional<uint64_t> version) const;
    // Under the lock: has scenes leave for so many more bytes. Errors: kCapacity.
    [[nodiscard]] Result<void> makeRoom(uint64_t bytes, const std::string& name);
    // Under the lock: the next one.
    Residents::iterator leave(Residents::iterator resident);
    // Under the lock: has what is not offered any more and nobody holds leave. Whether some of it
    // is still held.
    [[nodiscard]] bool dropWithdrawn();
    void keepContents(const std::string& id, Contents contents);
    [[nodiscard]] uint64_t bytesTaken() const;
    [[nodiscard]] static bool isHeld(const Resident& resident);
    // Under the lock.
    [[nodiscard]] bool isAwaited(const Coming& coming) const;
    // To be ended without the lock: the last reference to a session calls dismiss().
    [[nodiscard]] static Waiters present(const Coming& coming);
    void report(const std::string& id, const Progress& progress);
    void finish(const std::string& id, Result<session::SharedContext> outcome);
    void advance(const std::string& id, SceneMove& move);
    void settle(const std::string& id, std::unique_ptr<SceneSource> source);

    const SceneHostOptions options_;
    mutable std::mutex mutex_;
    std::condition_variable_any queued_;
    std::deque<std::string> queue_;
    std::map<std::string, Coming> coming_; // by id
    Residents residents_;
    std::map<std::string, Contents> contents_;          // by id, of all that were ever read
    std::vector<std::unique_ptr<SceneSource>> leaving_; // which the render thread ends
    bool withdrawn_ = false;                            // some of it may not be offered any more
    session::SceneCounts counts_;                       // of what adds up
    uint64_t last_number_ = 0;
    FrameSource* device_ = nullptr;
    uint64_t scene_bytes_ = 0;
    session::SharedContext first_;
    uint64_t first_version_ = 0;
    std::function<void()> wake_ = [] {};
    std::vector<std::jthread> readers_; // last: they end before what they use
};

} // namespace froxel::stream
