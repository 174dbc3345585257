// What the steps have in common that may expose and pack radiance as they make it, and those that
// light surfaces.
#pragma once

#include "interface/constants.h"
#include "render/frame/step.h"

#include <utility>
#include <vector>

namespace froxel::render {

// Whether a pixel's colour of the display follows from one sample of radiance.
[[nodiscard]] inline bool canPack(const settings::ViewSettings& settings) {
    return settings::samplesAcross(settings.antialiasing) == 1;
}

// Of a pass in compute: where its radiance goes.
[[nodiscard]] inline uint32_t packingFlags(const FramePlan& frame, const StepPlan& plan) {
    return (plan.leaves_radiance ? io::kOutputRadiance : 0U) |
           (plan.packs ? io::kOutputPixels | frame.tone_output_flags : 0U);
}

// `uses`, and those of such a pass's outputs.
[[nodiscard]] inline std::vector<Use> withPacking(std::vector<Use> uses, const StepPlan& plan) {
    if (plan.leaves_radiance) {
        uses.push_back(use::stored(Resource::kRadiance));
    }
    if (plan.packs) {
        uses.push_back(use::stored(*plan.packs));
    }
    return uses;
}

// `uses`, and those of whoever lights surfaces in a stage: what it looks up, or names in its
// shader.
[[nodiscard]] inline std::vector<Use> withLights(std::vector<Use> uses,
                                                 vk::PipelineStageFlags2 stage) {
    for (const Resource what : {Resource::kLists, Resource::kAtlas, Resource::kFroxels}) {
        uses.push_back(use::sampled(what, stage));
    }
    return uses;
}

// Flags of all materials that the forward shader shades from ids; 0: the rasteriser draws them, and
// the draw list has theirs.
[[nodiscard]] inline MaterialFlags shadedById(const StepInputs& inputs, const FramePlan& frame) {
    return frame.byIds()
               ? inputs.pose.materialSet()->solid_flags & ~frame.forward_unused_material_flags
               : 0;
}

} // namespace froxel::render
