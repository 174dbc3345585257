// Which passes a frame records, and as which variants: a pure function of what is asked for and of
// what there is to draw. What is not planned is neither recorded nor allocated.
#pragma once

#include "render/frame/effect_plan.h"
#include "render/pipelines/material_flags.h"
#include "settings/settings.h"

#include <cstdint>
#include <vector>

namespace froxel::render {

// What the frame has to work with.
struct FrameFacts {
    bool wide_gbuffer = false;        // SceneNeeds::wide_gbuffer
    uint32_t emission_exponent = 0;   // SceneNeeds::emission_exponent
    bool specular = false;            // SceneNeeds::specular
    bool edges = false;               // SceneNeeds::edges
    bool layers_visible = false;      // solid surfaces with layers are drawn by the rasteriser
    bool transparent_visible = false; // blended surfaces are in view
    bool unlit_solid = false;         // SceneNeeds::unlit
    bool local_lights = false;        // any light that has a place
    bool spots = false;
    bool areas = false;       // some of the spots are rectangles
    bool shadows = false;     // some of them have shadow maps
    bool equal_radii = false; // all local lights reach equally far
    bool small_scene = false; // light::nearestDistance() is less than usual
    bool long_loops = false;  // more iterations than a software rasteriser's loops may have
    bool directional = false;
    bool keep_radiance = false;    // the linear picture is asked for
    bool all_lights = false;       // lists are not asked for
    bool compute_batches = false;  // subgroups fetch lights together in compute
    bool fragment_batches = false; // and in the fragment stage
    bool culled_batches = false;   // and skip what adds nothing to any of their pixels
    bool whole_groups = false;     // a workgroup takes as long where nothing covers its pixels
    bool visibility = false;       // solid surfaces come from the visibility passes
    bool compute_raster = false;   // and these raster in compute
    bool cull_meshlets = true;
    bool prepass_pays = false;     // drawing depth first costs less than it spares
    bool overdraw_unknown = false; // the scene's was not measured yet
    bool bends = false;            // meshes follow joints or morph targets
    bool operator==(const FrameFacts&) const = default;
};

// For tests: what a frame is drawn as having, though it lacks it. Another variant and the same
// bits.
struct GenericParts {
    bool spots = false;
    bool directional = false;
    bool wide_gbuffer = false;
    bool transparent = false; // a blend pass over nothing, and a tone map of its own
    bool uneven_radii = false;
    bool plain_loops = false; // no lights fetched together
    bool uncut_loops = false; // none of them skipped
    bool operator==(const GenericParts&) const = default;
};
[[nodiscard]] FrameFacts generalised(FrameFacts facts, const GenericParts& parts);

struct FramePlan {
    bool pose = false;        // vertices that bend are posed, once for all passes
    bool pose_reused = false; // the posed vertices of the previous frame are valid
    bool depth_prepass = false;
    bool count_samples = false;    // an occlusion query counts fragments that pass the depth test
    bool forward = false;          // solid surfaces by the forward shader
    bool gbuffer = false;          // else by geometry pass and lighting pass
    bool visibility = false;       // solid surfaces by ids of triangles, culled on the device
    bool compute_raster = false;   // ids are rasterised in compute
    bool visibility_shade = false; // these are shaded at once, without a G-buffer
    // Depth, ids and G-buffer of the previous frame are valid (SurfacesDrawn): no pass draws them.
    bool reused = false;
    bool spoil_scratch = false; // FrameInputs::spoil_scratch, of such a frame
    bool cull_meshlets = true;
    bool lighting_compute = false;
    bool lighting_fragment = false;
    bool layers = false; // surfaces with layers by the forward shader, over what lighting left
    bool toon_pass = false;
    bool toon_bands = false; // of that pass; light flags say it of what lights
    bool outline = false;    // edges darkened, before anything is blended
    bool transparent = false;
    settings::Transparency transparency = settings::Transparency::kSorted; // where transparent
    uint32_t peel_layers = 0; // at most; 0: nothing is peeled
    bool over_unlit = false;  // what is blended may be before what has colours of the display
    bool samples = false;     // four a pixel: everything is drawn at twice the sides
    bool tonemap = false;     // a pass of its own
    bool lists = false;       // lights are assigned to clusters
    bool radiance = false;    // the radiance target exists
    bool count_pairs = false;
    settings::DebugView debug =
        settings::DebugView::kNone; // its passes; settings::replacesPicture(): and no
                                    // lighting

    std::vector<PlannedEffect> effects = {}; // in their order

    uint32_t forward_light_flags = 0;
    uint32_t lighting_light_flags = 0;
    uint32_t blended_output_flags = 0; // what effects ask of blended surfaces
    uint32_t tone_output_flags = 0;    // how radiance becomes a colour of the display
    uint32_t gbuffer_output_flags = 0;
    // What the shading model, or the G-buffer, has no use for.
    MaterialFlags forward_unused_material_flags = 0;
    MaterialFlags gbuffer_unused_material_flags = 0;
    uint32_t lighting_output_flags = 0;
    uint32_t toon_output_flags = 0;
    uint32_t tonemap_output_flags = 0;
    bool operator==(const FramePlan&) const = default;

    // Whether it has any there.
    [[nodiscard]] bool hasEffect(EffectPlace place) const;
    // Whether what is blended is drawn into targets of its own.
    [[nodiscard]] bool blendsApart() const {
        return transparent && (over_unlit || transparency != settings::Transparency::kSorted);
    }
};

// Whether surfaces are shaded as they are drawn, without a G-buffer.
[[nodiscard]] bool isForward(settings::Renderer renderer);
[[nodiscard]] bool isToon(settings::Renderer renderer);

// Whether the G-buffer has a word of what dielectrics reflect.
[[nodiscard]] bool storesSpecular(const settings::ViewSettings& settings, bool scene_specular);

// Whether surfaces with layers, for which the G-buffer has no room, are drawn over the lit ones.
[[nodiscard]] bool drawsLayers(const settings::ViewSettings& settings, bool scene_layers);

// Whether the plan has passes whose results the next frame may keep.
[[nodiscard]] bool leavesSurfaces(const FramePlan& plan);

// What the settings' pictures are drawn at: twice the sides where pixels have four samples.
[[nodiscard]] settings::Size drawnSize(const settings::ViewSettings& settings);

[[nodiscard]] FramePlan planFrame(const settings::ViewSettings& settings, const FrameFacts& facts);

} // namespace froxel::render
