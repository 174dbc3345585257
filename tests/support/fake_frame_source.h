// A frame source without a device: pictures of one colour that follows from the settings, and
// knobs to make it slow, full or lost. Any thread may turn the knobs.
#pragma once

#include "stream/frame_source.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace froxel::test {

// What the test sees of the fake; it outlives the source.
class FakeDevice {
  public:
    std::atomic<uint32_t> depth = 1;
    std::atomic<uint64_t> max_area_px = uint64_t{4096} * 4096; // larger pictures do not fit
    std::atomic<uint64_t> slow_area_px = uint64_t{1} << 40U;   // larger ones take too long
    std::atomic<uint64_t> max_beside_bytes = UINT64_MAX;       // nor does more beside them
    std::atomic<uint32_t> max_lights = UINT32_MAX; // lists of more do not fit, which shows late
    std::atomic<std::chrono::milliseconds> frame_time{}; // that a picture takes
    std::atomic<bool> detail_levels = false;
    std::atomic<float> coarse_px = 1e6F; // pictures with such a geometry error take no time
    std::atomic<std::chrono::milliseconds> estimate{}; // of it; 0: it is right
    std::atomic<uint32_t> piece_count = 1;             // of frames that begin from now on
    std::atomic<uint32_t> again_count = 0;   // that many frames need more than they were given
    std::atomic<uint32_t> unready_count = 0; // that many times nothing can begin yet
    std::atomic<std::chrono::milliseconds> unready_time{}; // that finding that out takes
    std::atomic<uint32_t> stage_count = 1;   // calls of begin() for the same that a frame takes,
    std::atomic<uint64_t> small_area_px = 0; // unless it is this small
    std::atomic<uint64_t> stage_calls = 0;   // that did not begin it
    std::function<void()> on_stage;          // within each; set before any
    std::atomic<bool> lost = false;
    std::atomic<bool> noisy = false; // pictures of noise, whose encoded size goes with all settings
    std::atomic<bool> computes = true; // false: refuses the forward renderers' compute stage
    std::atomic<uint64_t> begun_count = 0;
    std::atomic<uint64_t> unfit_count = 0;     // that did not begin, being too large
    std::atomic<uint64_t> beside_bytes = 0;    // as begin() was last told
    std::atomic<uint64_t> formed_count = 0;    // frames that may come in another form than pixels
    std::atomic<uint64_t> submitted_count = 0; // pieces
    std::atomic<uint64_t> abandoned_count = 0; // frames
    std::atomic<uint64_t> collect_count = 0;   // calls
    std::atomic<int> live_views = 0;
    std::atomic<int> made_views = 0;
    std::atomic<int> live_leases = 0;
    // Of scenes that are moved here.
    std::atomic<uint32_t> slice_count = 1; // calls that the move takes
    std::atomic<uint64_t> scene_bytes = 0; // each
    std::atomic<int> live_scenes = 0;
    std::atomic<int> live_moves = 0;
    std::atomic<int> outlived = 0; // scenes and moves that were there when the source went

    // While closed, collect() waits: the device is busy.
    void setGate(bool open);
    void passGate();
    [[nodiscard]] Seconds timeOf(const settings::ViewSettings& settings) const {
        return settings.geometry_error_px < coarse_px ? Seconds(frame_time.load()) : Seconds(0);
    }
    // Takes that long.
    void passTime(Seconds time);
    // The sizes of whole frames, in the order in which they were done.
    void addDone(settings::Size size);
    [[nodiscard]] std::vector<settings::Size> done();
    // The scenes of views, in the order in which these were made; "": the first one.
    void addView(const std::string& scene);
    [[nodiscard]] std::vector<std::string> views();
    // The settings of frames, in the order in which they began.
    void addBegun(const settings::ViewSettings& settings);
    [[nodiscard]] std::vector<settings::ViewSettings> begun();

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool open_ = true;
    std::vector<settings::Size> done_;
    std::vector<settings::ViewSettings> begun_;
    std::vector<std::string> views_;
};

[[nodiscard]] std::unique_ptr<stream::FrameSource>
makeFakeSource(std::shared_ptr<FakeDevice> device);

} // namespace froxel::test
