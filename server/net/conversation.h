// One viewer's conversation, without the socket: what a message does, what is to be written, and
// when the connection must close. One strand; never blocks.
#pragma once

#include "net/metrics.h"
#include "net/outbox.h"
#include "net/service.h"
#include "protocol/limits.h"
#include "session/command_reader.h"
#include "session/pacing.h"
#include "session/reject_budget.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel::net {

struct Closing {
    protocol::CloseCode code = protocol::CloseCode::kNormal;
    std::string reason; // at most 123 bytes, RFC 6455 section 5.5
};

class Conversation {
  public:
    // Commands that wait while the scene is loading.
    static constexpr size_t kMaxEarlyCommands = 64;

    Conversation(std::weak_ptr<session::FrameSink> sink, std::shared_ptr<Metrics> metrics)
        : sink_(std::move(sink)), metrics_(std::move(metrics)) {}
    ~Conversation();
    Conversation(const Conversation&) = delete;
    Conversation& operator=(const Conversation&) = delete;

    void onMessage(protocol::ByteSpan message, protocol::WireFormat format, TimePoint now);
    void onService(const ServiceStatus& status, TimePoint now);
    void onFrame(session::ReadyFrame frame);
    void onRefused(const Error& error,
                   const session::SessionState& refused,
                   const std::optional<session::SessionState>& drawn,
                   TimePoint now);
    void onDeviceLost(const Error& error);
    // No Hello came in time.
    void onHelloTimeout();

    // What to write next, when no write is under way.
    [[nodiscard]] std::optional<Outgoing> nextMessage(TimePoint now);
    // Set for good: nothing more is read, and the connection closes when nextMessage() gives none.
    [[nodiscard]] const std::optional<Closing>& closing() const { return closing_; }

    [[nodiscard]] size_t maxMessageBytes() const { return reader_.maxMessageBytes(); }
    [[nodiscard]] bool greeted() const { return reader_.greeted(); }
    [[nodiscard]] session::SessionId id() const { return id_; }                  // 0 before Welcome
    [[nodiscard]] const std::string& clientName() const { return client_name_; } // untrusted

  private:
    void handle(const session::CommandMessage& message, TimePoint now);
    void greet(const session::Hello& hello, TimePoint now);
    void begin(TimePoint now);
    void applyCommand(const session::CommandMessage& message, TimePoint now);
    void onAck(const session::CommandStamp& stamp, uint64_t frame_id, TimePoint now);
    void sayLoading();
    void reject(const session::Rejection& rejection, TimePoint now);
    void answer(const v1::ServerMessage& message);
    void close(protocol::CloseCode code, std::string reason);
    void grantCredits();
    [[nodiscard]] std::optional<Outgoing> detailsMessage();
    [[nodiscard]] Outgoing frameMessage(TimePoint now);

    const std::weak_ptr<session::FrameSink> sink_;
    const std::shared_ptr<Metrics> metrics_;
    session::CommandReader reader_;
    session::RejectBudget rejects_;
    session::CreditWindow window_;
    Outbox outbox_;
    ServiceStatus service_;
    std::vector<session::CommandMessage> early_;
    std::string client_name_;
    std::optional<session::SessionState> state_;   // from Welcome on
    std::optional<session::SessionState> welcome_; // as Welcome told it
    std::shared_ptr<const FrameDetails> told_details_;
    session::SessionId id_ = 0;
    uint64_t delivered_ = 0; // pictures that came from the stream
    uint64_t granted_ = 0;
    std::optional<Closing> closing_;
};

} // namespace froxel::net
