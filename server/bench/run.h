// A whole run: every row of its sweeps is timed, and its errors are taken.
#pragma once

#include "bench/result.h"
#include "render/scene/scene_needs.h"

#include <atomic>
#include <functional>
#include <utility>
#include <vector>

namespace froxel::render {
class Renderer;
}

namespace froxel::bench {

class Run {
  public:
    // All outlive it. `start` is what is known before anything is measured. `stop`: no frame begins
    // once it is set.
    Run(render::Renderer& renderer,
        const scene::Scene& scene,
        RunResult start,
        const std::atomic<bool>& stop)
        : renderer_(renderer), scene_(scene), needs_(render::findNeeds(scene)),
          result_(std::move(start)), stop_(stop) {}

    [[nodiscard]] const RunResult& result() const { return result_; }

    // `save` is called after every sweep. Throws StartupError where the device is lost or a
    // picture for a stream cannot be made.
    void measure(std::vector<Sweep> sweeps, const std::function<void(const RunResult&)>& save);

  private:
    // What a row is worth besides its times.
    RowResult finish(const Row& row, RowTimes times, ErrorMeter& meter) const;

    render::Renderer& renderer_;
    const scene::Scene& scene_;
    const render::SceneNeeds needs_;
    RunResult result_;
    const std::atomic<bool>& stop_;
};

} // namespace froxel::bench
