#include "render/lists/light_grid.h"

#include "cluster/light_spread.h"

namespace froxel::render {

void LightGrid::choose(const settings::ViewSettings& settings,
                       const light::FrameLights& lights,
                       const BoundsD3& scene_bounds_world,
                       cluster::Lit lit,
                       const cluster::GridCosts& costs) {
    lists_ = false;
    if (lights.lights.empty()) {
        why_ = "there is no point or spot light";
    } else if (settings.renderer == settings::Renderer::kNaive) {
        why_ = "the naive renderer loops over all lights";
    } else if (settings.light_loop == settings::LightLoop::kAllLights) {
        why_ = "looping over all lights was asked for";
    } else {
        chooseGrid(settings, lights, scene_bounds_world, lit, costs);
        return;
    }
    frames_left_ = 0; // the last choice's reason is gone
}

void LightGrid::chooseGrid(const settings::ViewSettings& settings,
                           const light::FrameLights& lights,
                           const BoundsD3& scene_bounds_world,
                           cluster::Lit lit,
                           const cluster::GridCosts& costs) {
    range_ = cluster::litDepthRange(lights, settings.camera, scene_bounds_world, lit);
    const Asked asked{settings.size,     settings.renderer, settings.grid, settings.light_loop,
                      settings.list_cap, settings.lights,   &costs};
    if (settings.list_cap >
        0) { // another grid caps other lights: no picture may depend on what was
        memory_ = {};
        frames_left_ = 0;
    }
    if (frames_left_ == 0 || asked != asked_) {
        makeChoice(settings, lights, costs);
        asked_ = asked;
        frames_left_ = kFramesAChoice;
    }
    --frames_left_;
    lists_ = !memory_.all_lights;
    if (lists_) {
        grid_ = cluster::makeClusterGrid(shape_, settings.size, settings.camera, range_.near_m,
                                         range_.far_m);
    }
}

void LightGrid::makeChoice(const settings::ViewSettings& settings,
                           const light::FrameLights& lights,
                           const cluster::GridCosts& costs) {
    const cluster::ClusterGrid frustum = cluster::makeClusterGrid(
        {.size = {1, 1, 1}}, settings.size, settings.camera, range_.near_m, range_.far_m);
    const cluster::LightSpread spread = cluster::lightSpread(frustum, lights);
    const cluster::GridFacts facts{.frustum = frustum,
                                   .range = range_,
                                   .law = settings.grid.law,
                                   .lights = spread,
                                   .costs = costs};
    automatic_ = settings.grid.automatic;
    if (automatic_) {
        cluster::GridChoice choice = cluster::chooseGrid(facts, memory_);
        shape_ = choice.shape;
        list_length_ = choice.list_length;
        grid_why_ = std::move(choice.why);
        memory_ = choice.memory;
    } else {
        shape_ = {.size = settings.grid.size, .law = settings.grid.law};
        list_length_ = cluster::expectedListLength(facts, shape_);
        grid_why_ = "its size was given";
    }
    const bool capped = settings.list_cap > 0;
    cluster::LoopChoice loop{false, capped ? "lists are capped" : "lists were asked for"};
    // All lights instead of capped lists would be another picture.
    if (settings.light_loop == settings::LightLoop::kAuto && !capped) {
        loop = cluster::chooseLoop(facts, list_length_, memory_);
    }
    memory_.all_lights = loop.all_lights;
    why_ = std::move(loop.why);
}

GridStats LightGrid::stats() const {
    if (!lists_) {
        return {};
    }
    return {.x = grid_.size.x,
            .y = grid_.size.y,
            .z = grid_.size.z,
            .tile_width_px = grid_.tile_width_px,
            .tile_height_px = grid_.tile_height_px,
            .near_m = range_.near_m,
            .far_m = range_.far_m,
            .automatic = automatic_,
            .why = grid_why_};
}

} // namespace froxel::render
