// What GET /metrics tells, in Prometheus' text format. Fed by connections as they send, never by
// the render thread, whose counts are read when somebody scrapes. Any thread; a lock inside is held
// for a few additions. Labels take values from fixed lists only, so rows are bounded whatever
// viewers send.
#pragma once

#include "core/frame_fates.h"
#include "core/frame_stats.h"
#include "guest/guest_store.h"
#include "session/rate_controller.h"
#include "session/rejection.h"
#include "session/scene_port.h"
#include "session/state_message.h"
#include "still/still_desk.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace froxel::net {

// Why a request over HTTP was refused.
enum class RequestRefusal : uint8_t {
    kToken,   // it showed none, or a wrong one
    kRate,    // too many came from there
    kForeign, // a page of another site had it asked
};

class Metrics {
  public:
    static constexpr const char* kContentType = "text/plain; version=0.0.4; charset=utf-8";

    // `version` is the server's. `session_count` gives the places taken at that moment; called by
    // text(), on its thread.
    explicit Metrics(
        const std::string& version = "unknown",
        std::function<size_t()> session_count = [] { return size_t{0}; });
    ~Metrics();
    Metrics(const Metrics&) = delete;
    Metrics& operator=(const Metrics&) = delete;

    // Sessions that the server takes at once; once.
    void setSessionCapacity(uint32_t sessions_max);
    // Times that the device was lost before this run; once.
    void setDeviceLosses(uint64_t count);
    // A viewer came in, and left: of a room each one.
    void sessionOpened();
    void sessionClosed();
    // A picture on its way to the socket, all stages known.
    void frameSent(const session::FrameRecord& record);
    void depthSent(size_t bytes);
    // A picture that a newer one replaced unsent.
    void frameDropped();
    void bytesSent(size_t count);
    // A message of a viewer that was answered by an error.
    void commandRejected(session::RejectCode code);
    // A WebSocket ended with this close code; 1006: without one.
    void socketClosed(uint16_t code);
    void upgradeRefused(unsigned http_status);
    // A connection over the limit was closed unanswered.
    void connectionRefused();
    void requestRefused(RequestRefusal why);
    // Nothing is counted for kNone.
    void rateStepped(session::RateStep step);

    // How long the render thread took to begin a frame, and the device for a piece of one. Any
    // thread.
    void frameBegun(Seconds took);
    void pieceDrawn(Seconds took);

    // Where pictures are counted on their way to a connection; text() reads it.
    [[nodiscard]] std::shared_ptr<FrameFates> fates() const;
    // Tells what the device's memory is used for at that moment; called by text(), on its thread.
    // Until it is set nothing is told of memory.
    void watchMemory(std::function<std::vector<MemoryUse>()> memory);

    // Tells how much of the device's time is taken, 0 to 1; called by text(), on its thread. Until
    // it is set it is 0.
    void watchLoad(std::function<double()> load);

    // Tells of the server's scenes; called by text(), on its thread. Until it is set nothing is
    // told of them.
    void watchScenes(std::function<session::SceneCounts()> scenes);
    // Likewise of the scenes that clients brought.
    void watchUploads(std::function<guest::GuestStore::Counts()> uploads);

    // Tells of stills; called by text(), on its thread. Until it is set nothing is told of them.
    void watchStills(std::function<still::StillCounts()> stills);

    // Tells how many lines of the log were lost since the start; called by text(), on its thread.
    // Until it is set it is 0.
    void watchLog(std::function<uint64_t()> lost);

    // docs/guide/metrics.md lists the names.
    [[nodiscard]] std::string text() const;

  private:
    struct Impl;
    const std::unique_ptr<Impl> impl_;
};

} // namespace froxel::net
