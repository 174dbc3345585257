// What a frame takes of the device's time, pass by pass, before it is drawn: from what its lists
// hold and by costs measured on lavapipe and on an H200 (tests/bench), scaled to this device. Pure.
#pragma once

#include "core/clock.h"
#include "core/error.h"
#include "render/device/unit_costs.h"
#include "render/frame/draw_list.h"
#include "render/frame/frame_pieces.h"
#include "render/frame/frame_plan.h"
#include "render/frame/step.h"
#include "render/lists/pair_bound.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace froxel::render {

// The host's facts of a frame that was built.
struct CostInputs {
    // Lights that take more than others, wherever they are.
    struct CostlyLights {
        uint32_t count = 0;
        double pair = 0; // seconds more, at a pixel
    };

    const DrawList& draws;
    FrameSize size;
    PairBound pairs;
    uint64_t longest_loop = 0; // of `pairs`, where it is more than a bound; 0: not known
    uint32_t directional_count = 0;
    std::vector<CostlyLights> costly_lights = {};
    double lit_pixel = 0;       // seconds more to light a pixel, whatever its lights
    double lit_surfaces = 1;    // largest factor on a pixel of the forward shader (litSurfaces())
    double overdraw = 1;        // of solid surfaces, in fragments per pixel
    uint32_t resolve_count = 1; // dispatches over the picture where ids are resolved
    std::span<const ActiveStep> steps = {};
};

struct PassEstimate {
    const char* pass = "";
    Seconds time{0};
};

[[nodiscard]] Seconds timeOf(const std::vector<PassEstimate>& passes);

// What two parts of a picture have in common.
[[nodiscard]] vk::Rect2D common(const vk::Rect2D& a, const vk::Rect2D& b);

// Of what is only done where a part has something in common with a region.
[[nodiscard]] RegionCost within(const RegionCost& cost, const vk::Rect2D& region);

// In pixels.
[[nodiscard]] inline double areaOf(const vk::Rect2D& region) {
    return static_cast<double>(region.extent.width) * region.extent.height;
}

// Of a pass over all of a target.
[[nodiscard]] Seconds timeOver(const RegionCost& cost, const settings::Size& size);

// Errors: kTooLong where looping over all lights, as these settings ask for, takes longer than
// `limit` whatever there is to see: told before any light is looked at.
[[nodiscard]] Result<void>
checkAllLights(const UnitCosts& unit, const settings::ViewSettings& settings, Seconds limit);

class FrameCosts {
  public:
    FrameCosts(const UnitCosts& unit, CostInputs load) : unit_(unit), inputs_(std::move(load)) {}

    // Over the drawn picture: solid surfaces' depth alone; with their material; by the forward
    // shader, each pixel so many times; ids resolved, with lights or without.
    [[nodiscard]] RegionCost depth() const;
    [[nodiscard]] RegionCost surfaces() const;
    [[nodiscard]] RegionCost shadedSurfaces(double each) const;
    [[nodiscard]] RegionCost resolved(bool shades) const;
    // Surfaces that what is behind shows through, once, over finished depth.
    [[nodiscard]] RegionCost layered(const LayeredDraws& draws) const;
    // A pass that only adds up lights.
    [[nodiscard]] RegionCost shading(const PairCost& unit) const;
    // Over another one: tone map, filters, what blending came to.
    [[nodiscard]] RegionCost screen() const;
    // Of an overlay, that cover so many pixels each.
    [[nodiscard]] Seconds lines(uint64_t count, double each_px) const {
        return Seconds(static_cast<double>(count) * (unit_.wire_line + each_px * unit_.wire_pixel));
    }
    // Of one pixel, a light, where the forward shader adds them up.
    [[nodiscard]] double shadedLoop(const PairCost& unit) const {
        return inputs_.lit_surfaces * unit.loop;
    }

    // For passes that loop over lights: shading all of them, without materials, seconds; and the
    // longest loop of one pixel, which cutting a region does not make shorter.
    [[nodiscard]] double lit(const vk::Rect2D& region, const PairCost& unit) const;
    [[nodiscard]] Seconds loop(const PairCost& unit) const;

    // Of all steps that are not reused, in order; what a frame takes that is not cut.
    [[nodiscard]] std::vector<PassEstimate> passes() const;
    [[nodiscard]] Seconds total() const;
    // Errors: kTooLong where that is more than `limit`, naming the dearest pass, or where one
    // loop, which cannot be cut, takes more than `loop_limit`.
    [[nodiscard]] Result<void> check(Seconds limit, Seconds loop_limit) const;
    // What the frame takes but for its local lights, and pairs of these that fit into what is left
    // of `limit`, at least into half of it.
    [[nodiscard]] double pairsWithin(Seconds limit) const;
    // How many lights one pixel may loop over.
    [[nodiscard]] uint64_t lightsWithin(Seconds limit) const;

    [[nodiscard]] const CostInputs& load() const { return inputs_; }
    [[nodiscard]] const UnitCosts& unit() const { return unit_; }

  private:
    // Of the frame's passes, seconds a light.
    [[nodiscard]] double slowestLoop() const;

    UnitCosts unit_;
    CostInputs inputs_;
};

} // namespace froxel::render
