// Where connections and the render loop meet without knowing each other: states go one way,
// frames the other, and credits flow back. Everything here may be called on any thread and never
// blocks on a device or a socket.
#pragma once

#include "core/encoded_frame.h"
#include "core/error.h"
#include "session/account.h"
#include "session/session_state.h"
#include "session/state_message.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace froxel::session {

using SessionId = uint64_t;

// A picture that is ready to be sent. Of those that decode by themselves the newest wins; one that
// does not (record.key) is of use only after every one since the last that did.
struct ReadyFrame {
    FrameRecord record; // all but send_wait_us and dropped_count, which the sender knows
    SharedBytes bytes;  // one picture, as record.delivered says
    std::shared_ptr<const protocol::CodedDepthMesh> depth{}; // where record.depth_mesh says so
    Seconds cost{0};      // what a frame costs where the server is slowest, for CreditWindow
    TimePoint ready_at{}; // when it left the encoder

    // Of a codec whose frames depend on those before them.
    [[nodiscard]] bool isVideo() const {
        return settings::rowOf(record.delivered.encoding.codec).frames_depend;
    }
};

// One viewer's connection, as the stream sees it.
class FrameSink {
  public:
    virtual ~FrameSink() = default;
    virtual void deliver(ReadyFrame frame) = 0;
    // The picture of `refused` cannot be made (kCapacity: its size does not fit; kUnsupported: the
    // device cannot do what its settings ask for). `drawn` is what was drawn last, none before the
    // first picture; the session falls back to it.
    virtual void refuse(Error error, SessionState refused, std::optional<SessionState> drawn) = 0;
    // Whether the next picture waits for shaders that are being compiled. Told of each change.
    virtual void compiling(bool /*under_way*/) {}
    // A picture that was drawn is lost: no encoder makes one of it. On an encoder's thread.
    virtual void notEncoded(Error /*error*/) {}
    // No picture comes any more.
    virtual void deviceLost(Error error) = 0;
};

// The stream, as a connection sees it.
class StreamPort {
  public:
    virtual ~StreamPort() = default;
    // Errors: kCapacity when the device has no time for one more; kDevice when it was lost.
    [[nodiscard]] virtual Result<SessionId> join(std::weak_ptr<FrameSink> sink,
                                                 const SessionState& state,
                                                 const Account& account,
                                                 TimePoint now) = 0;
    // For single pictures beside the sessions, of which no rate is kept: a small share of the
    // device's time is theirs while sessions want all of it. Errors: kDevice, kCapacity when the
    // stream ends.
    [[nodiscard]] virtual Result<SessionId> joinBeside(std::weak_ptr<FrameSink> sink,
                                                       const SessionState& state) = 0;
    // Whether join() would take one more session of this account now; its errors.
    [[nodiscard]] virtual Result<void> admits(const Account& account, TimePoint now) const = 0;
    // Replaces the state to draw; `arrived` is when the command behind it came in.
    virtual void update(SessionId id, const SessionState& state, TimePoint arrived) = 0;
    // How many frames the connection takes in all since it joined: those delivered to it so far
    // plus those that it has room for. A total cannot race with a delivery; 0 before the first.
    virtual void grant(SessionId id, uint64_t frame_total) = 0;
    // Whether any of its viewers takes frames, as at first; none does while all of them pause.
    virtual void setTakesFrames(SessionId id, bool takes) = 0;
    // What the link allows from now on; nothing is drawn for it alone, but that a resting picture
    // may become better.
    virtual void setDelivery(SessionId id, const Delivery& delivery) = 0;
    // The last call for this session.
    virtual void leave(SessionId id) = 0;
};

} // namespace froxel::session
