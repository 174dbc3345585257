// The render thread: owns the device's objects, draws for every session in turn, and hands the
// pictures to the encoders.
//
// 1. Takes the mailbox's news: states, credits, departures.
// 2. Gives the device a piece of a frame of the session that the scheduler names: the next one of
//    the frame begun last, or the first of a new one, where something changed or moves, its
//    connection granted a credit, and its pipeline has room.
// 3. With enough on the device, waits for the oldest piece; the last one's picture goes into its
//    session's pipeline. The pieces that wait of a frame that nobody wants any more are given up.
// 4. With nothing to do, sleeps until there is news, a session becomes due, or one that rests is to
//    be refined. A refined picture is drawn anew: its size may differ, and it costs one frame a
//    rest. Idle costs nothing.
#pragma once

#include "core/heartbeat.h"
#include "encode/encode_pool.h"
#include "session/stream_port.h"
#include "stream/admission.h"
#include "stream/device_demand.h"
#include "stream/frame_pipeline.h"
#include "stream/frame_scheduler.h"
#include "stream/frame_source.h"
#include "stream/scene_host.h"
#include "stream/viewer.h"
#include "stream/viewer_mailbox.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace froxel::stream {

struct RenderLoopOptions {
    Seconds min_frame_interval{1.0 / 60};
    std::shared_ptr<FrameFates> fates = std::make_shared<FrameFates>();
    // Of the host's memory for views that rest and add up samples: while as much is taken, others
    // wait.
    uint64_t means_bytes = uint64_t{256} << 20U;
    // Steps of frames, as the render thread begins them and as the device draws their pieces:
    // nobody else is served meanwhile. Runs on the render thread.
    std::function<void(Seconds)> on_begun = [](Seconds) {};
    std::function<void(Seconds)> on_piece = [](Seconds) {};
    // Of the scenes that sessions may go over to; null: they have the source's own. begin() was
    // called within make_source.
    std::shared_ptr<SceneHost> scenes;
    // Of the render thread, from the first frame on.
    std::shared_ptr<Heartbeat> heartbeat = std::make_shared<Heartbeat>();
    // Makes device and scene; runs on the render thread, which then owns them. May take long and
    // may throw.
    std::function<std::unique_ptr<FrameSource>()> make_source;
    // The source could not be made or the device was lost: the loop ends by itself and tells its
    // sessions. What the device may still use is never freed, so that the process should end by
    // quick_exit. Runs on the render thread.
    std::function<void(const Error&)> on_failure;
};

class RenderLoop final : public session::StreamPort {
  public:
    // The pool outlives the loop.
    RenderLoop(encode::EncodePool& pool, RenderLoopOptions options);
    ~RenderLoop() override;
    RenderLoop(const RenderLoop&) = delete;
    RenderLoop& operator=(const RenderLoop&) = delete;

    // Frames a second that active sessions must keep when another one joins, and the device time of
    // a newcomer's frame: see Admission. 0, the initial value, means that it is unknown. Any
    // thread.
    void setMinRate(double min_rate_hz, std::optional<Seconds> frame_cost = {});

    // What that frame is, so that its time is measured again each time that everybody has left.
    // Within make_source.
    void setNewcomersFrame(settings::ViewSettings settings);

    // Admission::load(). Any thread.
    [[nodiscard]] double load(TimePoint now) const;

    // Makes the render thread look for work. Any thread.
    void wake() { mailbox_->wake(); }

    // Waits for the frames under way; no sink is called after it. The port still answers.
    void stop();

    [[nodiscard]] Result<session::SessionId> join(std::weak_ptr<session::FrameSink> sink,
                                                  const session::SessionState& state,
                                                  const session::Account& account,
                                                  TimePoint now) override;
    [[nodiscard]] Result<session::SessionId>
    joinBeside(std::weak_ptr<session::FrameSink> sink, const session::SessionState& state) override;
    [[nodiscard]] Result<void> admits(const session::Account& account,
                                      TimePoint now) const override;
    void
    update(session::SessionId id, const session::SessionState& state, TimePoint arrived) override;
    void grant(session::SessionId id, uint64_t frame_total) override;
    void setTakesFrames(session::SessionId id, bool takes) override;
    void setDelivery(session::SessionId id, const session::Delivery& delivery) override;
    void leave(session::SessionId id) override;

  private:
    struct Piece {
        std::shared_ptr<BegunFrame> frame;
        Seconds charged{0}; // to its viewer so far
        TimePoint submitted{};
    };

    void run(const std::stop_token& stop);
    void serve(const std::stop_token& stop);
    void takeNews(const std::stop_token& stop);
    void lookAt(session::SessionId id, Viewer& viewer);
    void look(session::SessionId id, TimePoint now);
    void readNews();
    void priceAgain(const std::stop_token& stop);
    void takeState(Viewer& viewer, const ViewerNews& news);
    void chargeEncoding(session::SessionId id, Viewer& viewer);
    void updateReadiness(session::SessionId id, Viewer& viewer, TimePoint now);
    [[nodiscard]] std::optional<TimePoint> nextWake(std::optional<TimePoint> scenes_at) const;
    [[nodiscard]] SceneSource& sourceOf(const session::SessionState& state);
    void fail(const Error& error);
    void drain();
    void finishPictures();

    // Whatever ends the device's work throws StartupError.
    [[nodiscard]] bool meansFit() const;
    [[nodiscard]] bool deviceTakesMore() const;
    [[nodiscard]] Seconds spentSince(TimePoint begin);
    [[nodiscard]] bool startNext();
    [[nodiscard]] Seconds
    chargeFor(const Viewer& viewer, const BegunFrame& frame, Seconds cost) const;
    [[nodiscard]] bool beginFrame(session::SessionId id, Viewer& viewer, TimePoint now);
    [[nodiscard]] Result<FrameWork> beginWork(Viewer& viewer, const BegunFrame& frame);
    static void noteEstimate(Viewer& viewer, BegunFrame& frame, const FrameWork& work);
    void submitPiece(Viewer& viewer);
    void abandon(Viewer& viewer);
    static void end(Viewer& viewer, BegunFrame& frame);
    static void refuse(session::SessionId id, Viewer& viewer, const Error& error);
    void finishOldest();
    void finishPiece(Viewer& viewer, BegunFrame& frame, Result<Collected> collected);
    void finishFrame(Viewer& viewer, BegunFrame& frame, SourceFrame drawn);
    void keepRate(Viewer& viewer, const BegunFrame& frame, TimePoint now);
    [[nodiscard]] bool takeLeft(Viewer& viewer, BegunFrame& right);
    [[nodiscard]] static std::shared_ptr<ComparedSides>
    sidesOf(BegunFrame& right, FrameStats& right_stats, TimePoint now);
    [[nodiscard]] Seconds newcomersCost();
    [[nodiscard]] Seconds needOf(const BegunFrame& frame, const FrameStats& stats) const;

    const RenderLoopOptions options_;
    const uint32_t core_count_ = std::max(1U, std::thread::hardware_concurrency());
    encode::EncodePool& pool_;
    // Shared with the encoders, which may still be in a last wake() when the loop is gone.
    const std::shared_ptr<ViewerMailbox> mailbox_;
    mutable std::mutex admission_mutex_; // before the mailbox's
    Admission admission_;
    Seconds priced_{0};               // a newcomer's frame,
    std::optional<double> priced_at_; // at this pace of the device; none: its first
    FrameScheduler scheduler_;
    DeviceDemand demand_;
    // Viewers to whom something has happened since their readiness was told, or may at any time,
    // and those that become ready by themselves: looking at all of them, twice a frame, would take
    // longer than the frame.
    std::vector<session::SessionId> looks_;
    std::set<std::pair<TimePoint, session::SessionId>> ready_at_;
    std::unique_ptr<FrameSource> source_;
    std::map<session::SessionId, std::unique_ptr<Viewer>> viewers_;
    std::deque<Piece> submitted_;      // oldest first
    session::SteadyCost typical_cost_; // of whole frames, whoever's
    TimePoint accounted_{};            // until then this thread's time is charged
    TimePoint collected_{};            // the last piece
    std::optional<settings::ViewSettings> newcomers_frame_;
    bool watched_ = false; // by a session since there was none
    std::jthread thread_;  // last: ends before what it uses
};

} // namespace froxel::stream
