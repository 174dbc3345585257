// Bindings of the frame's set, which is set 0 of every pass over the scene. Their types are
// render::kFrameBindings.
#ifndef FROXEL_INTERFACE_FRAME_BINDINGS_H
#define FROXEL_INTERFACE_FRAME_BINDINGS_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kFrameBinding = 0U;
FROXEL_CONST uint kLightsBinding = 1U;
FROXEL_CONST uint kListsBinding = 2U;   // clusters' light lists
FROXEL_CONST uint kIndicesBinding = 3U; // that they consist of
FROXEL_CONST uint kSpotsBinding = 4U;
FROXEL_CONST uint kSunsBinding = 5U; // directional lights
FROXEL_CONST uint kFogBinding = 6U;
FROXEL_CONST uint kFogVolumeBinding = 7U;
FROXEL_CONST uint kShadowOfLightBinding = 8U; // which shadow maps a light has
FROXEL_CONST uint kShadowLightsBinding = 9U;
FROXEL_CONST uint kShadowAtlasBinding = 10U;
FROXEL_CONST uint kAreasBinding = 11U; // rectangular lights
FROXEL_CONST uint kLtcBinding = 12U;   // linearly transformed cosines, which those take
FROXEL_CONST uint kEnvironmentBinding = 13U;
FROXEL_CONST uint kLevelsBinding = 14U;             // of what is around
FROXEL_CONST uint kLobesBinding = 15U;              // what lobes reflect of it
FROXEL_CONST uint kTransmissiveDepthBinding = 16U;  // of the nearest surface that transmits light
FROXEL_CONST uint kTransmittanceAtlasBinding = 17U; // beside the shadow maps'
FROXEL_CONST uint kFrameBindingCount = 18U;

FROXEL_IO_NAMESPACE_END

#endif
