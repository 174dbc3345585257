// One viewer's conversation, without the socket: what a message does, what is to be written, and
// when the connection must close. One strand; never blocks.
#pragma once

#include "core/allowance.h"
#include "net/lobby.h"
#include "net/metrics.h"
#include "net/outbox.h"
#include "net/read_budget.h"
#include "net/service.h"
#include "net/token_gate.h"
#include "session/command_reader.h"
#include "session/pacing.h"
#include "session/rate_controller.h"
#include "session/reject_budget.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel::net {

class Conversation {
  public:
    // Commands that wait while the scene is loading.
    static constexpr size_t kMaxEarlyCommands = 64;
    // States sent at once, and a second: one says all that commands before it set, and a flood of
    // them must not take a slow link from the pictures.
    static constexpr double kStatesAtOnce = 16;
    static constexpr double kStatesPerSecond = 5;
    // A pick looks at up to 20,000 lights.
    static constexpr double kPicksAtOnce = 10;
    static constexpr double kPicksPerSecond = 5;
    // Scenes selected: each may be read and moved to the device.
    static constexpr double kScenesAtOnce = 10;
    static constexpr double kScenesPerSecond = 1;
    // A pause that begins or ends: each end has a picture drawn, and video go on with a key frame.
    static constexpr double kPausesAtOnce = 16;
    static constexpr double kPausesPerSecond = 5;
    // Requests for depth, and their ends: a picture is drawn for each request.
    static constexpr double kDepthRequestsAtOnce = 16;
    static constexpr double kDepthRequestsPerSecond = 5;
    // Messages to a client of more bytes are made away from the network's threads.
    static constexpr size_t kLongBytes = size_t{8} * 1024;

    // `viewer` is what the session tells; whatever it is told goes to onNotice(). `caller` is who
    // connected, by address. Without a `gate` everybody is let in.
    Conversation(std::weak_ptr<SessionViewer> viewer,
                 std::shared_ptr<Lobby> lobby,
                 std::shared_ptr<Metrics> metrics,
                 Caller caller = {},
                 std::shared_ptr<const TokenGate> gate = nullptr)
        : viewer_(std::move(viewer)), lobby_(std::move(lobby)), metrics_(std::move(metrics)),
          caller_(std::move(caller)), gate_(std::move(gate)) {}
    // Its session is kept for the grace time, unless either side has said good-bye.
    ~Conversation();
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;
    // What the destructor does with its place, before it: nothing is sent or handled after this.
    void leave();

    void onMessage(protocol::ByteSpan message, protocol::WireFormat format, TimePoint now) {
        onDecoded(session::decodeCommand(message, format), format, now);
    }
    // A message that session::decodeCommand() gave this for, on whatever thread.
    void onDecoded(session::CommandResult<session::CommandMessage> command,
                   protocol::WireFormat format,
                   TimePoint now);
    // The client says more than is read of one.
    void onFlood(ReadBudget::Standing standing);
    void onService(const ServiceStatus& status, TimePoint now);
    void onNotice(Notice notice);
    // The client closed the connection on purpose.
    void onGoodbye() { goodbye_ = true; }
    // No Hello came in time.
    void onHelloTimeout() {
        if (!closing_ && !greeted()) {
            close(protocol::CloseCode::kPolicy, "no hello within 5 s");
        }
    }

    // What to write next, when no write is under way.
    [[nodiscard]] std::optional<Outgoing> nextMessage(TimePoint now);
    // When nextMessage() may have something though nothing happens; none: it will not.
    [[nodiscard]] std::optional<TimePoint> wakeAt(TimePoint now) const;
    // Set for good: nothing more is read, and the connection closes when nextMessage() gives none.
    [[nodiscard]] const std::optional<Closing>& closing() const { return closing_; }

    [[nodiscard]] size_t maxMessageBytes() const { return reader_.maxMessageBytes(); }
    [[nodiscard]] bool greeted() const { return reader_.greeted(); }
    // 0 before Welcome
    [[nodiscard]] session::SessionId id() const { return seat_ ? seat_->session->id() : 0; }
    [[nodiscard]] const std::string& clientName() const { return hello_.client_name; } // untrusted

  private:
    void handle(const session::CommandMessage& message, TimePoint now);
    void greet(const session::CommandMessage& message, TimePoint now);
    void begin(TimePoint now);
    void sayWelcome();
    void onCommand(const session::CommandMessage& message, TimePoint now);
    void applyCommand(const session::CommandMessage& message, TimePoint now);
    void changeControl(const session::CommandMessage& message, TimePoint now);
    void selectScene(const session::CommandMessage& message, TimePoint now);
    void saySceneNews();
    void setPaused(bool paused, TimePoint now);
    void requestKeyFrame(TimePoint now);
    [[nodiscard]] bool offersDepth() const;
    void requestDepth(const session::CommandMessage& message, TimePoint now);
    void countDrops(uint32_t before);
    void onFrame(session::ReadyFrame frame);
    void onAck(const session::CommandStamp& stamp, const session::Ack& ack, TimePoint now);
    void followLink(TimePoint now);
    void sayLoading();
    void drain(const Draining& draining);
    void reject(const session::Rejection& rejection, TimePoint now);
    void rejectRate(const session::CommandStamp& stamp,
                    double per_second,
                    const std::string& what,
                    TimePoint now);
    void tellError(const session::Rejection& rejection);
    void answer(v1::ServerMessage message);
    void close(protocol::CloseCode code, std::string reason);
    void grantCredits();
    [[nodiscard]] Outgoing inReply(v1::ServerMessage message) const;
    [[nodiscard]] Outgoing stateMessage();
    void mendVideo(TimePoint now);
    [[nodiscard]] std::optional<Outgoing> detailsMessage();
    [[nodiscard]] std::optional<Outgoing> depthMessage();
    void signRecord(session::FrameRecord& record);
    [[nodiscard]] Outgoing frameMessage(TimePoint now);

    const std::weak_ptr<SessionViewer> viewer_;
    const std::shared_ptr<Lobby> lobby_;
    const std::shared_ptr<Metrics> metrics_;
    Caller caller_; // by its token, once that is known
    const std::shared_ptr<const TokenGate> gate_;
    session::CommandReader reader_;
    session::RejectBudget rejects_;
    session::CreditWindow window_;
    session::RateController rate_;
    std::optional<session::Delivery> told_delivery_; // none before the first acknowledgement
    Outbox outbox_;
    Allowance states_{kStatesAtOnce, kStatesPerSecond};
    Allowance room_states_{kStatesAtOnce, kStatesPerSecond};
    Allowance scene_states_{kStatesAtOnce, kStatesPerSecond};
    Allowance scenes_{kScenesAtOnce, kScenesPerSecond};
    Allowance picks_{kPicksAtOnce, kPicksPerSecond};
    Allowance pauses_{kPausesAtOnce, kPausesPerSecond};
    Allowance depth_requests_{kDepthRequestsAtOnce, kDepthRequestsPerSecond};
    ServiceStatus service_;
    std::vector<session::CommandMessage> early_;
    session::Hello hello_;                // its secrets are forgotten when they have served
    std::optional<TokenGate::Pass> pass_; // of who had to show a token
    bool left_ = false;                   // the seat
    std::optional<Seat> seat_;            // from Welcome on
    session::CommandStamp newest_;        // of this connection's commands that set state
    session::CommandStamp shown_;         // the newest of them that a picture has shown
    std::shared_ptr<const FrameDetails> told_details_;
    settings::PlacedLights told_placed_;
    uint64_t delivered_ = 0; // pictures that came from the session
    uint64_t granted_ = 0;
    bool paused_ = false;
    bool wants_depth_ = false;
    uint64_t told_depth_ = 0; // number of the newest mesh sent
    size_t depth_bytes_ = 0;  // sent since the last picture
    bool video_lost_ = false; // a frame of video was dropped, and no key frame has come since
    std::optional<TimePoint> key_at_; // one is asked for then, since it was too early
    bool goodbye_ = false;
    bool told_draining_ = false;
    std::optional<Closing> closing_;
};

} // namespace froxel::net
