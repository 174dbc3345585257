// Draws a sweep's rows in turns and notes their times.
#pragma once

#include "bench/budget.h"
#include "bench/progress.h"
#include "bench/sweep.h"
#include "core/frame_stats.h"
#include "encode/jpeg_format.h"
#include "render/frame/frame_inputs.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace froxel::render {
class Renderer;
}

namespace froxel::bench {

// Timed frames are this far apart on the lights' clock, as in `froxel render`.
struct RowTimes {
    struct Pass {
        std::string name;
        size_t frame_count = 0;
        std::vector<double> gpu_us; // of the frames that tell it
    };
    std::string skipped;        // why there are no frames, else empty
    std::string note;           // why there are fewer than wanted, else empty
    std::vector<double> gpu_us; // of the frames that tell it
    std::vector<double> host_us;
    std::vector<double> frame_us;
    std::vector<double> cpu_us; // of all threads of this process
    std::vector<Pass> passes;   // in the order of first use
    FrameStats last;

    [[nodiscard]] bool measured() const { return !frame_us.empty(); }
};

class Runner {
  public:
    // All outlive it. `stop`: no frame begins once it is set.
    Runner(render::Renderer& renderer,
           const Budget& budget,
           const std::atomic<bool>& stop,
           Progress& progress)
        : renderer_(renderer), budget_(budget), stop_(stop), progress_(progress) {}

    // As many as there are rows. Each turn has a viewer of its own, so that memory is the row's and
    // no row sees another's lists. Throws StartupError where the device is lost.
    [[nodiscard]] std::vector<RowTimes> time(const Sweep& sweep, const Base& base);

  private:
    // Errors: kIo, kInvalidArgument.
    [[nodiscard]] Result<render::FrameInputs> inputsFor(const Row& row, double time_s);
    // Draws the row's first frames; how many more it may have. Fills times.skipped or times.note.
    uint32_t warmUp(const Row& row, double time_s, RowTimes& times, double& frame_s);
    std::vector<uint32_t>
    warmUpAll(const Sweep& sweep, const Base& base, std::vector<RowTimes>& times);
    void draw(const Turn& turn, const Row& row, double time_s, RowTimes& times);

    render::Renderer& renderer_;
    Budget budget_;
    const std::atomic<bool>& stop_;
    Progress& progress_;
    encode::JpegFormats jpeg_formats_;
};

} // namespace froxel::bench
