// Single pictures for whoever asks, drawn between sessions' frames.
//
// 1. A still that was drawn is given again. One that is being drawn is waited for by all who ask.
// 2. A scene that is not on the device is loaded, one after another.
// 3. A worker is a viewer of the stream without a connection (StreamPort::joinBeside) that takes
// one
//    picture after another. It goes when it rests, so that its view's memory is others', and at
//    once where its scene is not the server's first, so that the scene may leave.
//
// Any thread.
#pragma once

#include "core/allowances.h"
#include "session/account.h"
#include "session/scene_port.h"
#include "session/stream_port.h"
#include "still/still_store.h"
#include "still/still_view.h"
#include "still/unsent.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace froxel::still {

struct StillRequest {
    std::string scene; // its id, untrusted; empty: the server's first
    Entries view;
    settings::Codec codec = settings::Codec::kJpeg;
    bool thumbnail = false; // kept apart from the others, which may be many
    bool kept = true;       // whether the picture is given again; one of a comparison never is
    std::string tag;        // of what the picture is a function of
};

// Where stills are drawn; all outlive the desk's use of them.
struct StillSource {
    session::SharedContext first;
    session::StreamPort* port = nullptr;
    session::ScenePort* scenes = nullptr;
};

struct StillRefusal {
    session::Rejection why;
    std::optional<settings::Size> fits = {}; // about the largest picture that would do
    std::optional<std::chrono::seconds> retry_after = {};
};

struct StillPicture {
    SharedBytes bytes;
    // What it was drawn of and how it was encoded; null where it was drawn for another one before.
    session::SharedContext scene{};
    settings::Encoding encoding{};
    std::string compared{}; // session::comparedReport() as JSON; empty: nothing was compared
};

using StillOutcome = std::variant<StillPicture, StillRefusal>;

struct StillLimits {
    size_t workers = 4;
    size_t per_account = 9; // waited for: a sheet of all named views
    size_t waiting = 64;    // by all
    // Of answers that are drawn or on their way; one alone may be larger. Of all_bytes an account
    // that has less of them has its share: others' answers have to go for it (Unsent::shrinkTo).
    uint64_t account_bytes = 256 << 20U;
    uint64_t all_bytes = 1 << 30U;
    // Of one account that are drawn, at most and usually; 0: as many as it asks for.
    double per_minute = 600;
    double at_once = 60;
    uint64_t kept_bytes = 32 << 20U;
    uint64_t kept_thumbnail_bytes = 16 << 20U;
    Seconds patience{60}; // from the request to the picture
    Seconds linger{10};   // of a worker that rests
};

struct StillCounts {
    uint64_t drawn_total = 0;
    uint64_t kept_total = 0; // given again
    uint64_t refused_total = 0;
    uint64_t put_off_total = 0; // told to come back
};

class StillDesk final : public session::SceneWaiter,
                        public std::enable_shared_from_this<StillDesk> {
  public:
    using Answer = std::function<void(StillOutcome)>;
    using Ticket = uint64_t;

    explicit StillDesk(const StillLimits& limits);

    // Told when expire() is due next; any thread, must not block. Set before the first request.
    void setAlarm(std::function<void(TimePoint)> alarm) { alarm_ = std::move(alarm); }

    // `answer` is called once, on any thread and maybe within, unless it is cancelled. It counts as
    // on its way until its bytes are let go. No limits of its own: `account` is none.
    Ticket ask(const StillSource& source,
               StillRequest request,
               const std::optional<session::Account>& account,
               Answer answer,
               TimePoint now);
    // The bytes of an answer that was made of stills, counted as theirs, or why not now.
    [[nodiscard]] StillOutcome
    hold(const SharedBytes& bytes, const std::optional<session::Account>& account, TimePoint now);
    // Nobody waits for it any more. It may be answered meanwhile.
    void cancel(Ticket ticket);
    // Ends what was waited for too long, and workers that rest; sets off the alarm for when more is
    // due.
    void expire(TimePoint now);
    [[nodiscard]] StillCounts counts() const;
    // Sets off no alarm from now on.
    void close();

    // Of the scenes that it waits for.
    void onSceneProgress(const std::string& /*id*/, const Progress& /*progress*/) override {}
    void onScene(const std::string& id, Result<session::SharedContext> scene) override;
    // Whoever looks at it goes first.
    [[nodiscard]] bool isPatient() const override { return true; }

  private:
    struct Waiter {
        Ticket ticket = 0;
        std::optional<session::Account> account;
        Answer answer;
    };
    enum class Stage : uint8_t { kScene, kQueued, kDrawing };
    struct Job {
        StillRequest request;
        StillSource source;
        Stage stage = Stage::kScene;
        std::optional<TimePoint> scene_asked; // of the port, since
        bool scene_again = false;             // once, after the device had no room for it
        std::optional<TimePoint> scene_at;
        std::vector<Waiter> waiters;
        TimePoint due{};
        std::optional<session::SessionState> state; // from kQueued on
        uint64_t bytes = 0;                         // of its answer, at most; 0: not known yet
    };
    using Jobs = std::list<Job>; // oldest first

    class StillWorker;
    friend class StillWorker;
    // What is done when the lock is let go.
    using Calls = std::vector<std::function<void()>>;
    // Holds the lock, and makes the calls after it.
    template <class Step>
    void locked(const Step& step);

    void add(const StillSource& source,
             StillRequest request,
             Waiter waiter,
             TimePoint now,
             Calls& calls);
    // What was asked for and is not answered yet, by all and by an account.
    struct Waiting {
        size_t all = 0;
        size_t own = 0;
        uint64_t all_bytes = 0; // of the answers, as far as known
        uint64_t own_bytes = 0;
    };
    [[nodiscard]] Waiting waiting(const std::optional<session::Account>& account) const;
    // Errors: why not now.
    [[nodiscard]] std::optional<StillRefusal>
    whyNot(const std::optional<session::Account>& account, bool is_new, TimePoint now);
    // Why an answer of so many bytes is not to be held as well.
    [[nodiscard]] std::optional<StillRefusal>
    whyNotHeld(const std::optional<session::Account>& account, uint64_t bytes, TimePoint now);
    // No job waits for this one's scene any more, unless another does.
    void dismissScene(const Job& gone);
    void putOff(Waiter& waiter, StillRefusal refusal, Calls& calls);
    void wantScenes(TimePoint now, Calls& calls);
    void onSceneHere(Jobs::iterator job,
                     const session::SharedContext& scene,
                     TimePoint now,
                     Calls& calls);
    void drawNext(TimePoint now, Calls& calls);
    [[nodiscard]] std::shared_ptr<StillWorker> freeWorkerFor(const Job& job);
    void draw(Jobs::iterator job,
              const std::shared_ptr<StillWorker>& worker,
              TimePoint now,
              Calls& calls);
    // It draws no more of what it was given: it takes the next one, or rests.
    void goOn(StillWorker& worker, TimePoint now, Calls& calls);
    void finish(Jobs::iterator job, const StillOutcome& outcome, Calls& calls);
    void setNextAlarm(TimePoint now) const;
    void rest(StillWorker& worker, TimePoint now);
    void leave(StillWorker& worker);
    void onDrawn(StillWorker& worker, session::ReadyFrame frame);
    void onRefused(StillWorker& worker, const Error& error);
    void onLost(const Error& error);
    [[nodiscard]] StillStore& storeFor(const StillRequest& request);

    const StillLimits limits_;
    std::function<void(TimePoint)> alarm_ = [](TimePoint) {};
    mutable std::mutex mutex_; // before those of the ports
    Ticket last_ticket_ = 0;
    Jobs jobs_;
    std::vector<std::shared_ptr<StillWorker>> workers_;
    Allowances<session::Account> allowances_;
    StillStore kept_;
    StillStore thumbnails_;
    const std::shared_ptr<Unsent> unsent_ = std::make_shared<Unsent>();
    StillCounts counts_;
};

} // namespace froxel::still
