// What a frame is asked for, and what it may take. Plain values.
#pragma once

#include "core/clock.h"
#include "core/host_form.h"
#include "core/outputs.h"
#include "motion/playback.h"
#include "render/frame/frame_plan.h"
#include "settings/settings.h"

#include <cstdint>
#include <optional>

namespace froxel::render {

// How a deferred frame's solid surfaces reach the G-buffer. auto: through the visibility passes on
// a GPU that has what they need, where they are faster. Differs in rounding alone.
enum class GeometryPath : uint8_t { kAuto, kRaster, kVisibility, kComputeRaster };

// Where light lists are made. auto: on a GPU that rounds as the host does, else on the host. The
// lists are the same.
enum class AssignmentPlace : uint8_t { kAuto, kHost, kDevice };

struct FrameInputs {
    settings::ViewSettings settings;
    double time_s = 0; // the lights' clock; pauses and speed are already folded in
    // What plays of the scene; none: what Motion::played says, at time_s.
    std::optional<motion::Playing> playing = {};
    // What rests since the view's frame before is not drawn again: the same bits, sooner. Not for
    // whoever measures what a whole frame takes.
    bool keep_surfaces = false;
    Outputs outputs = {}; // that its pixels come with
    HostForm form = {};   // of the picture
    // For tests and measurements.
    GenericParts generic = {};
    bool spoil_scratch = false; // whatever a frame with kept surfaces must not read is overwritten
    GeometryPath geometry = GeometryPath::kAuto;
    bool cull_meshlets = true;              // in the visibility passes
    std::optional<bool> depth_prepass = {}; // none: where it pays
    AssignmentPlace assignment = AssignmentPlace::kAuto;
    // What the picture takes beside the renderer, to be encoded: of the view's memory, too.
    uint64_t beside_bytes = 0;

    bool operator==(const FrameInputs&) const = default;
};

// How long frames and their pieces may take by their estimates. The defaults are for whoever has
// the device alone; whoever shares it wants less.
struct WorkLimits {
    Seconds frame{100}; // beyond: refused, before anything is allocated
    Seconds piece{10};
    Seconds loop{10}; // one pixel's over its lights, which nothing cuts; beyond: refused
    // After so much of the host's part others get the thread, at the end of its stage.
    std::optional<Seconds> host = {};
};

// What a view's frames have shown since those limits were set.
struct WorkPace {
    // Times as long as by the device's unit costs, which were measured when it was opened. Frames
    // are cut and loops are bounded as if it were 1 at least, so that no view that is easier than
    // its estimates makes the device's pieces long.
    double pace = 1;
    double frame_share = 1; // times WorkLimits::frame
};

} // namespace froxel::render
