// The scene of `froxel render` and `froxel record` on the device, and pictures of it.
#pragma once

#include "app/render_command.h"
#include "app/timings_report.h"
#include "core/linear_image.h"
#include "core/outputs.h"
#include "motion/playback.h"
#include "path/camera_path.h"
#include "render/view/renderer.h"
#include "scene/scene.h"
#include "session/session_state.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace froxel::app {

// That the file of --out is made of; none: pixels.
[[nodiscard]] Outputs outputsOf(const RenderOptions& options);

// A picture to be written.
struct Still {
    render::RenderedFrame frame;  // the last one
    std::vector<std::byte> rgba8; // the mean of several; empty: there was one
    LinearImage linear;           // where radiance is kept

    [[nodiscard]] PixelView pixels() const {
        PixelView view = frame.pixels.view();
        if (!rgba8.empty()) {
            view.data = rgba8.data();
            view.stride_bytes = size_t{4} * view.width_px;
        }
        return view;
    }
};

// Of settings that have these otherwise.
[[nodiscard]] session::SessionState
changed(const RenderOptions& options, const TimedRun& run, const session::SettingChanges& changes);

// The scene on the device, and the run that a picture of it begins with. Throws StartupError.
class Drawing {
  public:
    // Of each picture, and how many came before it.
    using OnPicture = std::function<void(const Still&, uint32_t index)>;

    explicit Drawing(const RenderOptions& options);

    [[nodiscard]] const TimedRun& start() const { return run_; }
    // Pictures that draw() draws: of all of the path, else as the options say.
    [[nodiscard]] uint32_t pictureCount(const RenderOptions& options) const;
    // Draws every picture and fills run.frames; returns the last one.
    [[nodiscard]] Still
    draw(const RenderOptions& options, TimedRun& run, const OnPicture& on_picture = nullptr);

  private:
    [[nodiscard]] static scene::Scene readScene(const RenderOptions& options);
    [[nodiscard]] static TimedRun startOf(const RenderOptions& options,
                                          const scene::Scene& scene,
                                          const gpu::DeviceTraits& device);
    // Cameras as they stand at that time.
    [[nodiscard]] const scene::Scene& posed(const RenderOptions& options);

    scene::Scene scene_;
    gpu::Device device_;
    TimedRun run_;
    const motion::Playback playback_;
    render::Renderer renderer_;
    std::optional<path::CameraPath> path_; // none: the camera rests
};

} // namespace froxel::app
