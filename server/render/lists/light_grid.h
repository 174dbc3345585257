// Which grid a view's frame has, and whether its pixels loop over lists or over all lights.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/grid_choice.h"
#include "core/frame_stats.h"
#include "core/math.h"
#include "light/frame_lights.h"
#include "settings/settings.h"

#include <string>

namespace froxel::render {

// Keep one a view: it remembers its last choice, so that grids do not flip from frame to frame.
// Nothing that it decides changes the picture, but where lists are capped.
class LightGrid {
  public:
    // Decides for one frame and makes the grid if it needs one. `costs` lives as long as this.
    void choose(const settings::ViewSettings& settings,
                const light::FrameLights& lights,
                const BoundsD3& scene_bounds_world,
                cluster::Lit lit,
                const cluster::GridCosts& costs);

    // Whether there are lists, and with them a grid.
    [[nodiscard]] bool lists() const { return lists_; }
    [[nodiscard]] const cluster::ClusterGrid& grid() const { return grid_; }
    [[nodiscard]] GridStats stats() const;
    // Lights that a pixel is expected to loop over where there are lists.
    [[nodiscard]] double listLength() const { return list_length_; }
    // Why lists, or why not.
    [[nodiscard]] const std::string& why() const { return why_; }

  private:
    // What a choice is made for, besides what moves: the camera and the lights.
    struct Asked {
        settings::Size size;
        settings::Renderer renderer{};
        settings::Grid grid;
        settings::LightLoop light_loop{};
        uint32_t list_cap = 0;
        settings::Lights lights;
        const cluster::GridCosts* costs = nullptr;
        bool operator==(const Asked&) const = default;
    };
    // A choice takes 0.3 ms, and what moves changes little in so many frames.
    static constexpr uint32_t kFramesAChoice = 16;

    void chooseGrid(const settings::ViewSettings& settings,
                    const light::FrameLights& lights,
                    const BoundsD3& scene_bounds_world,
                    cluster::Lit lit,
                    const cluster::GridCosts& costs);
    // From range_.
    void makeChoice(const settings::ViewSettings& settings,
                    const light::FrameLights& lights,
                    const cluster::GridCosts& costs);

    bool lists_ = false;
    bool automatic_ = false;
    Asked asked_;              // by the last choice
    uint32_t frames_left_ = 0; // that it stands for
    cluster::GridShape shape_;
    std::string why_;
    std::string grid_why_;
    double list_length_ = 0;
    cluster::DepthRange range_{};
    cluster::ClusterGrid grid_;
    cluster::GridMemory memory_;
};

} // namespace froxel::render
