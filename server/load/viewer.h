// One viewer: a real WebSocket connection that speaks the protocol as the page does, and decodes
// no picture. It "paints" the newest frame at the next refresh of a 60 Hz display and acknowledges
// it then; a frame that a newer one overtakes before that is dropped and acknowledged at once.
#pragma once

#include "load/counted_tcp.h"
#include "load/picture_check.h"
#include "load/script.h"
#include "load/served.h"
#include "load/stages.h"
#include "load/target.h"
#include "load/viewer_meter.h"
#include "protocol/framing.h"

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace froxel::load {

struct ViewerOptions {
    Target target;
    std::optional<ThinkTime> think;
    std::optional<v1::SetSize> size;
    std::optional<uint32_t> light_count;
    std::optional<v1::SetEncoding> encoding;
    std::string room;                // shared by all; empty: each has a session of its own
    bool depth = false;              // asks for it, as a page that warps pictures does
    std::vector<std::string> tokens; // shown in turn; none: none
    std::shared_ptr<boost::asio::ssl::context> tls; // for a target that asks for it
};

struct ViewerResult {
    Measured measured;
    std::optional<Served> served;       // as measuring began; none: it never did
    bool controlled = true;             // false: watched in a room, and said nothing of the script
    std::optional<std::string> failure; // one line; none: all went well
    bool refused = false;               // the failure: the server had no place for this one
    bool tried = false;                 // to connect; the run may end before
    std::optional<double> first_frame_ms;      // from connecting; with --size and --lights applied
    std::optional<double> first_frame_wait_ms; // it left or ended before that came, after so long
    uint64_t received_bytes = 0; // of the connection while measuring, all framing included
    uint64_t sent_bytes = 0;
    uint64_t key_frames = 0; // of video, since connecting
};

// One viewer since the last look at it.
struct ViewerChange {
    uint32_t number = 0;
    bool tried = false;    // to connect
    bool joining = false;  // has no first frame yet
    bool watching = false; // has one, and has not ended
    std::optional<std::string> failure;
    bool refused = false;
    std::optional<double> first_frame_ms;
    Measured measured;           // since then
    Samples waiting;             // what end() would add now
    uint64_t received_bytes = 0; // since then, of what is measured
};

// What one viewer does, and when; see ViewerResult for what it says.
struct ViewerPlan {
    uint32_t number = 1; // from 1, each its own
    ScriptChoice script;
    Visit visit;
    bool measures_alone = false; // from its first frame on; false: begin() says when
};

// Everything runs on `executor`, which must be serial; so do the calls.
class Viewer : public std::enable_shared_from_this<Viewer> {
  public:
    // No first frame for this long after connecting began: it failed. Loading a scene is in it.
    static constexpr std::chrono::seconds kFirstFrameTimeout{60};
    // After the end, for the server's answer to Close.
    static constexpr std::chrono::seconds kCloseTimeout{2};

    // kJoined: has a first frame, or ended without one. Then one of the others, each once.
    enum class Event : uint8_t { kJoined, kLeft, kFailed };
    Viewer(boost::asio::any_io_executor executor,
           const ViewerOptions& options,
           ViewerPlan plan,
           std::function<void(Event)> report);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    // Connects and leaves as it is planned.
    void start(TimePoint run_start);
    // Measuring and the script begin.
    void begin(TimePoint now);
    // Measuring ends, and the connection is closed. kLeft follows, unless kFailed came before.
    void end(TimePoint now);

    [[nodiscard]] ViewerChange takeChange(TimePoint now);
    // After kLeft or kFailed.
    [[nodiscard]] ViewerResult result() const;

  private:
    struct Unpainted {
        uint64_t frame_id = 0; // 0: none
        TimePoint received_at;
        [[nodiscard]] uint32_t heldUs() const {
            return static_cast<uint32_t>(Microseconds(Clock::now() - received_at).count());
        }
    };
    using Code = boost::system::error_code;
    using Stream = boost::beast::websocket::stream<transport::PeerStream<CountedTcp>, false>;

    // A handler that does nothing once the viewer has ended, and fails it on an error.
    template <class Work>
    auto guarded(Work work) {
        return [self = shared_from_this(), work](Code failure, auto&&...) {
            if (self->ended_ || failure == boost::asio::error::operation_aborted) {
                return;
            }
            if (failure) {
                self->fail(failure.message());
            } else {
                work(*self);
            }
        };
    }
    void connect();
    void onConnected();
    void secure();
    void upgrade();
    void onUpgraded();
    void read();
    void onRead(Code failure);
    void onFrame(protocol::ByteSpan message, TimePoint now);
    void onDepth(protocol::ByteSpan message);
    void onMessage(const v1::ServerMessage& message, TimePoint now);
    void onWelcome(const v1::Welcome& welcome, TimePoint now);
    void paintLater(uint64_t frame_id, TimePoint now);
    void acknowledge(const Unpainted& frame);
    void playNext();
    void onStepDue();
    void send(v1::ClientMessage message, TimePoint now);
    void write();
    void endMeasuring(TimePoint now);
    void fail(const std::string& why);
    void refuse(const std::string& why);
    void finish();
    [[nodiscard]] CountedTcp& tcp() { return stream_.next_layer().next_layer(); }
    [[nodiscard]] ByteCounter& traffic() { return tcp().rate_policy(); }

    void onState(const v1::ViewState& state, TimePoint now);
    // Whether this one may say what its script says: in a room only who controls it.
    [[nodiscard]] bool controls() const;

    const ViewerOptions& options_;
    const ViewerPlan plan_;
    const std::function<void(Event)> report_;
    boost::asio::ip::tcp::resolver resolver_;
    Stream stream_;
    boost::beast::websocket::response_type response_;
    boost::beast::flat_buffer buffer_;
    boost::asio::steady_timer deadline_; // to connect at, for the first frame, for the close
    boost::asio::steady_timer leave_;
    boost::asio::steady_timer refresh_;
    boost::asio::steady_timer step_timer_;

    TimePoint connecting_since_;
    std::optional<v1::Welcome> welcome_;
    v1::ViewState state_; // as told last before measuring
    std::unique_ptr<Script> script_;
    TimePoint script_start_;
    std::optional<Step> step_;
    uint64_t sent_seq_ = 0;
    uint64_t setup_seq_ = 0; // the first frame shows this one
    Unpainted unpainted_;
    std::deque<std::string> outgoing_;
    size_t outgoing_bytes_ = 0;
    bool ended_ = false;
    bool closing_ = false;
    PictureCheck pictures_;
    uint64_t depth_mesh_ = 0; // number of the newest
    ViewerMeter meter_;
    ViewerResult result_;
    uint64_t received_before_ = 0;
    uint64_t received_taken_ = 0; // by takeChange()
    uint64_t sent_before_ = 0;
};

} // namespace froxel::load
