// What the render thread knows of one session: what it wants, what it was given and what is under
// way for it. Render thread only.
#pragma once

#include "core/allowance.h"
#include "render/view/sample_mean.h"
#include "session/affordable_scale.h"
#include "session/rate_keeper.h"
#include "session/refinement.h"
#include "session/steady_cost.h"
#include "session/stream_port.h"
#include "stream/frame_pipeline.h"
#include "stream/frame_source.h"
#include "stream/viewer_mailbox.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace froxel::stream {

// A frame from its beginning until its last piece on the device was collected.
struct BegunFrame {
    session::SessionId id = 0;
    session::FrameRecord record;
    session::SessionState state;
    TimePoint started{};
    uint64_t number = 1; // of those of its viewer that were begun, or would be
    uint32_t piece_count = 1;
    uint32_t submitted_count = 0;
    uint32_t on_device = 0;    // pieces
    Seconds estimate{0};       // what all of it is expected to take of the device
    double limit_share = 0;    // of the longest that a frame may take
    Seconds piece_estimate{0}; // what a piece is expected to take
    Seconds longest_piece{0};  // of those collected
    Seconds cost{0};           // so far, with the host's part, as the scheduler charges it
    Seconds host{0};           // of which the host took
    Seconds held{0};           // how long its pieces were the device's oldest, as the host saw it
    bool over = false;         // nothing more of it will be submitted
    uint32_t sample = 0;       // of those whose mean is the picture
    uint32_t sample_count = 1;
    TimePoint began{}; // `started`, but of a right side later
    // Of a right side, which is drawn as the left one was: that one. Null: it is none.
    std::shared_ptr<BegunFrame> left = {};
    // Of a left side, once it is there.
    std::optional<SourceFrame> drawn = {};
    Seconds need{0}; // what it kept others from

    [[nodiscard]] bool isLastSample() const { return sample + 1 == sample_count; }
    // Whether the picture needs another frame, of the right side.
    [[nodiscard]] bool isLeftSide() const { return state.comparison && !left; }
};

struct Viewer {
    Viewer(const ViewerNews& first, std::shared_ptr<FramePipeline> its_pipeline);

    std::weak_ptr<session::FrameSink> sink;
    std::shared_ptr<FramePipeline> pipeline;
    session::SharedContext source_scene;      // which `source` is of, and stays for
    std::unique_ptr<ViewSource> source;       // made with the first frame of a scene
    std::unique_ptr<ViewSource> right_source; // of a comparison's right side; made with its first
    uint64_t right_number = 0;                // BegunFrame::number of the last one
    session::SessionState state;
    TimePoint arrived{};
    std::optional<session::SessionState> submitted; // what the device was last given
    std::optional<session::SessionState> drawn;     // what it last made a picture of
    double drawn_scale = 1;                         // of that
    std::shared_ptr<BegunFrame> built;              // half: see FrameWork::half_built
    std::shared_ptr<BegunFrame> waiting;            // begun last, while pieces of it wait
    std::shared_ptr<BegunFrame> left;               // begun, whose right side is not
    uint64_t last_frame_id = 0;
    uint64_t begun_count = 0; // frames
    uint64_t started = 0;     // frames, without those lost on the way
    uint64_t granted = 0;
    uint32_t under_way = 0; // frames on the device or waiting for it
    session::Delivery delivery;
    session::RateKeeper rate_keeper;
    session::AffordableScale affordable;       // in the scene that `source` is of
    std::optional<settings::Size> no_room_for; // in full, as far as was tried
    const bool beside; // single pictures: at the size asked for, or not at all
    session::RefinementSchedule refinement;
    session::SteadyCost frame_cost;
    render::SampleMean mean;           // of the samples so far of a view that rests
    bool amid_samples = false;         // begun, and not the last one
    Seconds piece_cost{0};             // the longest of the last frame; 0 before it
    TimePoint paced_until{};           // by the delivery's interval
    TimePoint shown_at{};              // of the frame begun last
    TimePoint ask_again{};             // nothing can begin before; see FrameWork::piece_count
    bool looked_at = false;            // with the others at the next look
    std::optional<TimePoint> ready_at; // when it becomes ready if nothing happens before
    std::optional<TimePoint> compiling_since; // shaders that the next picture needs
    bool told_compiling = false;
    bool changed = true;
    bool blocked = false; // this state was refused; waits for another
    bool leaving = false;
    bool gave_up = false; // the last frame, because of what the viewer asked for meanwhile

    // Shaders that the next picture needs are being compiled, or no longer. The connection hears of
    // what takes long enough to be noticed.
    void noteCompiling(bool compiles, TimePoint now);
    [[nodiscard]] bool idle() const { return under_way == 0 && pipeline->size() == 0; }
    [[nodiscard]] bool moves() const { return changed || state.animatingAt(shown_at); }
    // When the next frame is due, as far as that is up to this viewer; none: nothing is to be
    // drawn.
    [[nodiscard]] std::optional<TimePoint> wantsFrameAt() const;
    // The frame to go on with: the half built one, unless it is given up for what was asked for
    // meanwhile, by the rule of waitsInVain(); or a new one.
    [[nodiscard]] std::shared_ptr<BegunFrame> build(session::SessionId id, TimePoint now);
    // Whether the next frame is the first of several samples.
    [[nodiscard]] bool beginsMean() const;
    // Memory for the mean that is under way.
    [[nodiscard]] uint64_t meanBytes() const;
    void dropMean();
    // With the last sample gives the mean in its place; false: there is no picture yet.
    [[nodiscard]] bool addSample(const BegunFrame& frame, PixelLease& pixels);
    void noteBegun(const std::shared_ptr<BegunFrame>& frame, TimePoint now);
    // Of the frame's side; null: there is none yet.
    [[nodiscard]] std::unique_ptr<ViewSource>& sourceOf(const BegunFrame& frame) {
        return frame.left ? right_source : source;
    }
    // Frees what the last comparison took, once nothing of it is under way.
    void endComparison();
    [[nodiscard]] bool hasRoom() const;
    // Whether it takes no picture, and none is on the way to it.
    [[nodiscard]] bool pauses() const { return idle() && started >= granted; }
    // Whether nobody wants the rest of the frame that waits. Where the one before it was given up
    // because of a change, the next change does not end this one: a camera that never rests gets
    // pictures too.
    [[nodiscard]] bool waitsInVain() const;
    // The present picture takes too long at its size; whether it is to be tried smaller.
    [[nodiscard]] bool shrink(const Error& error);
    // A picture was refused. How many were since the last line in the log, with this one; none: no
    // line, since that one was written within a second.
    [[nodiscard]] std::optional<uint64_t> noteRefusal(TimePoint now);

  private:
    [[nodiscard]] std::optional<session::RefinementSchedule::Due> refineNext() const;
    [[nodiscard]] std::shared_ptr<BegunFrame> buildRight(TimePoint now) const;
    // due: none where the view moves.
    [[nodiscard]] session::Delivered
    nextDelivered(const std::optional<session::RefinementSchedule::Due>& due) const;

    Allowance refusal_lines_{1, 1};
    uint64_t untold_refusals_ = 0;
};

} // namespace froxel::stream
