// The frame, from top to bottom: every step that there is. A frame has those that its settings and
// its scene ask for.
#pragma once

#include "render/frame/step_plan.h"

#include <array>

namespace froxel::render {

extern const StepRow kBackgroundStep;
extern const StepRow kBlendedBehindStep;
extern const StepRow kBlendedStep;
extern const StepRow kBloomStep;
extern const StepRow kDebugViewStep;
extern const StepRow kDepthMeshStep;
extern const StepRow kDepthStep;
extern const StepRow kEnvironmentStep;
extern const StepRow kExposureStep;
extern const StepRow kFogStep;
extern const StepRow kForwardStep;
extern const StepRow kFragmentsStep;
extern const StepRow kFxaaStep;
extern const StepRow kGbufferStep;
extern const StepRow kIdsStep;
extern const StepRow kJpegStep;
extern const StepRow kLayersStep;
extern const StepRow kLightingStep;
extern const StepRow kLinearDepthStep;
extern const StepRow kListsStep;
extern const StepRow kOutlineStep;
extern const StepRow kPairsStep;
extern const StepRow kPlanesStep;
extern const StepRow kPoseStep;
extern const StepRow kRadianceReadbackStep;
extern const StepRow kReadbackStep;
extern const StepRow kShadowsStep;
extern const StepRow kTonemapStep;
extern const StepRow kToonStep;
extern const StepRow kTransmissionDepthStep;
extern const StepRow kTransmissionStep;
extern const StepRow kWiresStep;

inline constexpr std::array kOrder = {
    // What surfaces are drawn from and lit by.
    &kPoseStep,
    &kListsStep,
    &kShadowsStep,
    &kEnvironmentStep,
    // Solid surfaces.
    &kIdsStep,
    &kDepthStep,
    &kGbufferStep,
    &kForwardStep,
    &kLightingStep,
    &kLayersStep,
    &kToonStep,
    &kOutlineStep,
    // What is shown in their place or counted of them.
    &kFragmentsStep,
    &kDebugViewStep,
    &kPairsStep,
    // Behind them, around them, in front of them.
    &kBackgroundStep,
    &kFogStep,
    &kExposureStep,
    &kTransmissionDepthStep,
    &kBlendedBehindStep,
    &kTransmissionStep,
    &kBlendedStep,
    // Over all of the linear picture.
    &kBloomStep,
    &kWiresStep,
    // Colours of the display.
    &kTonemapStep,
    &kFxaaStep,
    // What the host reads.
    &kJpegStep,
    &kPlanesStep,
    &kReadbackStep,
    &kRadianceReadbackStep,
    &kLinearDepthStep,
    &kDepthMeshStep,
};

} // namespace froxel::render
