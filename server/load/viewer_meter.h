// What one viewer measures, all on its own clock. No sockets; the caller passes the time.
//
//   latency   from sending a command to having the last byte of the first frame that shows it, by
//             the frame's echo of that command's seq and client time; the newest one that a frame
//             shows, as the page has it. Decoding is not in it.
//   reaction  as latency, but of every command: also of those that newer ones overtook on the way,
//             and of cameras that were not sent since others waited for the socket, from when they
//             should have been. A command that no frame has shown at the end counts with its wait
//             so far. Where commands come faster than frames, a command's mean wait for the next
//             frame is in this one only.
//   age       of a picture when its last byte is there: latency without queue_us, the wait on the
//             server before drawing began. The command's way up is still in it. Of frames that show
//             no new command, and so of a room's watchers, by load/frame_ages.h: there it may be a
//             lower bound.
//   network   latency without the server's stages: the ways up and down, and this process.
//   interval  from one frame's last byte to the next one's, as far as a frame was due: always while
//             lights move or the script never rests, else from the oldest command that no frame
//             has shown. From begin() to the first frame and from the last one to end() too, so
//             that no stall is left out. None is due to a viewer that pauses, nor, while lights
//             rest, to one whose script is idle or over. To a watcher one is always due of a
//             script that never rests, since its room's controller is taken to play that. A command
//             that changes nothing of a resting picture is shown by no frame, and counts as one
//             that waits.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "load/frame_ages.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace froxel::load {

// Samples of one viewer, in the order of its frames; what frames did not end comes last.
struct Samples {
    std::vector<double> latency_ms;
    std::vector<double> reaction_ms;
    std::vector<double> age_ms;
    std::vector<double> interval_ms;
    // The server's stages as in FrameHeader; queue and network only with a new command.
    std::vector<double> queue_ms;
    std::vector<double> render_ms;
    std::vector<double> encode_wait_ms;
    std::vector<double> encode_ms;
    std::vector<double> send_wait_ms;
    std::vector<double> network_ms;
    std::vector<double> gpu_ms;       // a part of the render stage, where it is known
    std::vector<double> timer_lag_ms; // how late this process sent a command

    void add(const Samples& other);
};

// All of them, for what treats them alike.
struct SampleSeries {
    std::string_view name;
    std::vector<double> Samples::*samples;
    bool is_stage = false;
};
inline constexpr std::array kSampleSeries = {
    SampleSeries{"latency", &Samples::latency_ms},
    SampleSeries{"reaction", &Samples::reaction_ms},
    SampleSeries{"age", &Samples::age_ms},
    SampleSeries{"interval", &Samples::interval_ms},
    SampleSeries{"queue", &Samples::queue_ms, true},
    SampleSeries{"render", &Samples::render_ms, true},
    SampleSeries{"encode_wait", &Samples::encode_wait_ms, true},
    SampleSeries{"encode", &Samples::encode_ms, true},
    SampleSeries{"send_wait", &Samples::send_wait_ms, true},
    SampleSeries{"network", &Samples::network_ms, true},
    SampleSeries{"gpu", &Samples::gpu_ms},
    SampleSeries{"timer_lag", &Samples::timer_lag_ms}};

struct PictureSize {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    [[nodiscard]] uint64_t area() const { return uint64_t{width_px} * height_px; }
    bool operator==(const PictureSize&) const = default;
};

// What adds up, of several viewers and over time.
struct Counts {
    uint64_t frames = 0;
    uint64_t frame_bytes = 0; // encoded pictures and their headers
    uint64_t depth_meshes = 0;
    uint64_t depth_bytes = 0;      // of these, with their headers
    uint64_t server_dropped = 0;   // replaced by newer ones before sending
    uint64_t client_dropped = 0;   // arrived, and never painted
    uint64_t commands = 0;         // sent, but acknowledgements
    uint64_t commands_skipped = 0; // cameras not sent since others waited for the socket
    uint64_t commands_unshown = 0; // sent or skipped, and shown by no frame until the end
    uint64_t errors = 0;           // Error messages
    std::map<v1::ErrorCode, uint64_t> errors_by_code;
};

struct Measured : Counts {
    Samples samples; // age_ms from end() on
    double seconds = 0;
    std::optional<std::string> first_error; // its text, made printable
    std::optional<PictureSize> smallest;    // of the frames
    std::optional<PictureSize> largest;

    // Of a frame.
    void addSize(const PictureSize& size);
    // Of another viewer, or of a later time of the same one; all but `seconds`.
    void add(const Measured& other);
    [[nodiscard]] double framesPerSecond() const {
        return seconds > 0 ? static_cast<double>(frames) / seconds : 0;
    }
};

class ViewerMeter {
  public:
    // From now on counts; what was shown so far is not new. `restless`: the script never rests.
    void begin(TimePoint now, bool restless = false);
    // After begin().
    void end(TimePoint now);
    [[nodiscard]] bool counting() const { return counting_; }

    // Its client_time_us: the clock's own microseconds.
    [[nodiscard]] static uint64_t stampOf(TimePoint now);
    // A command of the script is handed to the socket; `due` is when it should have been.
    void onCommand(uint64_t seq, const v1::ClientMessage& said, TimePoint due, TimePoint now);
    // A camera is not sent, and the next command shows where it would have been; `seq` is that of
    // the next message.
    void onCommandSkipped(uint64_t seq, TimePoint due);
    // As Welcome and every StateChanged tell it.
    void onState(const v1::ViewState& state, TimePoint now);
    // Its last byte is here; `sent_seq` is the newest command sent. Errors: kInvalidArgument for
    // an echo of what was never sent.
    [[nodiscard]] Result<void>
    onFrame(const v1::FrameHeader& header, size_t bytes, uint64_t sent_seq, TimePoint now);
    void onDepth(size_t bytes);
    // A newer frame was there before this one was painted.
    void onFrameDropped();
    void onError(const v1::Error& error);
    // The scene that is shown from now on. To choose it once more calls off what was chosen since,
    // and no frame shows that.
    void onScene(const std::string& id);

    [[nodiscard]] const Measured& measured() const { return measured_; }
    // What was measured since the last call, or since begin(). Ages come at the end alone.
    [[nodiscard]] Measured takeNew(TimePoint now);
    // Samples that end() would add now: of a frame that is due, and of commands that wait.
    [[nodiscard]] Samples waiting(TimePoint now) const;

  private:
    // Since when a frame should have come; none: none is due.
    [[nodiscard]] std::optional<TimePoint> dueSince() const;
    void setPaused(bool paused, TimePoint now);
    void addStages(const v1::FrameHeader& header, std::optional<double> latency_ms);

    bool counting_ = false;
    bool restless_ = false;
    bool paused_ = false;
    bool lights_move_ = false;
    double clock_rate_ = 0; // the lights' seconds in one of ours
    TimePoint began_;
    TimePoint last_frame_; // or where frames began to be due after it
    FrameAges ages_;
    uint64_t shown_seq_ = 0;
    // A command that no frame has shown yet.
    struct Unseen {
        uint64_t seq = 0;
        TimePoint sent;
        bool other_scene = false; // it chose another than is shown
    };
    std::deque<Unseen> unseen_; // oldest first
    std::string scene_;         // that is shown
    uint64_t last_id_ = 0;
    uint64_t dropped_before_ = 0;
    uint64_t dropped_now_ = 0;
    Measured measured_;
    Counts taken_; // by takeNew(), as are these:
    double taken_seconds_ = 0;
    std::array<size_t, kSampleSeries.size()> taken_samples_{};
};

} // namespace froxel::load
