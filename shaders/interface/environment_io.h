// Light from around: what surfaces look up of it.
#ifndef FROXEL_INTERFACE_ENVIRONMENT_IO_H
#define FROXEL_INTERFACE_ENVIRONMENT_IO_H

#include "compat.h"

#ifdef __cplusplus
#define FROXEL_ENVIRONMENT_FUNCTION [[nodiscard]] inline
#else
#define FROXEL_ENVIRONMENT_FUNCTION
#endif

FROXEL_IO_NAMESPACE_BEGIN

struct Environment {
    mat3 map_from_view; // directions into the axes of the panorama
    vec3 matt[9];       // environment::Diffuse's terms in these axes, times the strength
    float strength;
    float background_alpha; // of the lobe that blurs what shows behind the scene
};
FROXEL_SIZE_ASSERT(Environment, 152);

// The levels of environment::Prefiltered, one after another, each with its faces in their order. A
// face has its neighbours' texels around it: [face][-1 to size][-1 to size], (red, green, blue, 0).
FROXEL_CONST uint kEnvironmentSize = 128U; // texels of a face's side in the finest level
FROXEL_CONST uint kEnvironmentLevels = 6U;

// Where a level's texels begin; of kEnvironmentLevels: how many there are. The sum of 6 (size +
// 2)^2 over the finer levels.
FROXEL_ENVIRONMENT_FUNCTION uint environmentTexel(uint level) {
    uint size = kEnvironmentSize >> level;
    return 8U * (kEnvironmentSize * kEnvironmentSize - size * size) +
           48U * (kEnvironmentSize - size) + 24U * level;
}

// Of environment::albedoTable(): (all, grazing), rows by roughness.
FROXEL_CONST uint kLobeTableSize = 32U;
FROXEL_CONST float kLobeLeastRoughness = 0.045F;

FROXEL_IO_NAMESPACE_END

#endif
