// What one viewer measures, all on its own clock. No sockets; the caller passes the time.
//
//   latency   from sending a command to having the last byte of the first frame that shows it, by
//             the frame's echo of that command's seq and client time; the newest one that a frame
//             shows, as the page has it. Decoding is not in it.
//   reaction  as latency, but of every command: also of those that newer ones overtook on the way.
//             Where commands come faster than frames, a command's mean wait for the next frame is
//             in this one only.
//   age       of a picture when its last byte is there: latency without queue_us, the wait on the
//             server before drawing began. The command's way up is still in it. Known for frames
//             that show a new command.
//   network   latency without the server's stages: the ways up and down, and this process.
//   interval  from one frame's last byte to the next one's.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "froxel/v1/server.pb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace froxel::load {

// The server's stages, in order; FrameHeader says what each is. kQueue only with a new command.
enum class Stage : uint8_t { kQueue, kRender, kEncodeWait, kEncode, kSendWait, kNetwork };
inline constexpr std::array kStageNames = {
    std::string_view("queue"),  std::string_view("render"),    std::string_view("encode_wait"),
    std::string_view("encode"), std::string_view("send_wait"), std::string_view("network")};

// Samples of one viewer, in the order of its frames.
struct Samples {
    std::vector<double> latency_ms;
    std::vector<double> reaction_ms;
    std::vector<double> age_ms;
    std::vector<double> interval_ms;
    std::array<std::vector<double>, kStageNames.size()> stage_ms;
    std::vector<double> gpu_ms;       // a part of the render stage
    std::vector<double> timer_lag_ms; // how late this process sent a command
};

struct Measured {
    Samples samples;
    double seconds = 0;
    uint64_t frames = 0;
    uint64_t frame_bytes = 0;           // encoded pictures and their headers
    uint64_t server_dropped = 0;        // replaced by newer ones before sending
    uint64_t client_dropped = 0;        // arrived, and never painted
    uint64_t commands = 0;              // sent, but acknowledgements
    uint64_t commands_skipped = 0;      // cameras not sent since others waited for the socket
    uint64_t refusals = 0;              // Error messages
    std::optional<std::string> refusal; // the first one's text, made printable
};

class ViewerMeter {
  public:
    // From now on counts; what was shown so far is not new.
    void begin(TimePoint now);
    // After begin().
    void end(TimePoint now);
    [[nodiscard]] bool counting() const { return counting_; }

    // Its client_time_us: the clock's own microseconds.
    [[nodiscard]] static uint64_t stampOf(TimePoint now);
    // A command of the script is handed to the socket; `due` is when it should have been, `shows`
    // whether it has any effect on frames.
    void onCommand(uint64_t seq, bool shows, TimePoint due, TimePoint now);
    void onCommandSkipped();
    // Its last byte is here; `sent_seq` is the newest command sent. Errors: kInvalidArgument for
    // an echo of what was never sent.
    [[nodiscard]] Result<void>
    onFrame(const v1::FrameHeader& header, size_t bytes, uint64_t sent_seq, TimePoint now);
    // A newer frame was there before this one was painted.
    void onFrameDropped();
    void onRefusal(const v1::Error& error);

    [[nodiscard]] const Measured& measured() const { return measured_; }

  private:
    void addStages(const v1::FrameHeader& header, std::optional<double> latency_ms);

    bool counting_ = false;
    TimePoint began_;
    std::optional<TimePoint> last_frame_;
    uint64_t shown_seq_ = 0;
    std::deque<std::pair<uint64_t, TimePoint>> unseen_; // seq and time sent, oldest first
    uint64_t last_id_ = 0;
    uint64_t dropped_before_ = 0;
    uint64_t dropped_now_ = 0;
    Measured measured_;
};

} // namespace froxel::load
