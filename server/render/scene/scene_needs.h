// What a scene has, and so which shader features, vertex streams and passes it needs.
#pragma once

#include "render/pipelines/material_flags.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace froxel::render {

// Of materials that are drawn together.
struct SurfaceNeeds {
    bool wide_gbuffer = false;      // metalness, occlusion, emission or unlit somewhere
    bool wide_lambert = false;      // the same without metalness
    uint32_t emission_exponent = 0; // emission over 2 to the power of this fits the G-buffer
    bool specular = false; // a solid surface reflects unlike a usual dielectric: ior, specular
    // A surface reflects less than all at its edges: its strength is below 1, or a film is over it.
    bool edges = false;
    bool layers = false; // a solid surface has layers over it: a coat
    bool masked = false;
    bool blended = false;
    bool transmissive = false; // light passes it as through glass
    bool unlit = false;        // a solid surface is

    void add(const SurfaceNeeds& other);
};

struct SceneNeeds : SurfaceNeeds { // of all materials
    std::vector<MaterialFlags> material_flags;
    std::vector<SurfaceNeeds> of_material;
    uint32_t primitive_count = 0;
    uint32_t extended_count = 0; // primitives with a second texcoord, colours or tangents
    struct Lights {
        uint32_t points = 0;
        uint32_t spots = 0;
        uint32_t directionals = 0;
    } lights; // the scene's own
};

// layers: false where the device cannot draw them (texture_limit.h); surfaces are drawn without.
[[nodiscard]] SceneNeeds findNeeds(const scene::Scene& scene, bool layers = true);

} // namespace froxel::render
