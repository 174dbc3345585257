// Which steps a frame has, and as which variants: a pure function of what is asked for and of what
// there is to draw. What is not planned is neither recorded nor allocated.
#pragma once

#include "core/host_form.h"
#include "core/outputs.h"
#include "render/frame/step_plan.h"
#include "render/pipelines/material_flags.h"
#include "settings/settings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::render {

// How solid surfaces reach depth and G-buffer.
enum class SolidGeometry : uint8_t {
    kRaster,     // the rasteriser draws them
    kIds,        // it draws ids of triangles, culled on the device, which compute resolves
    kComputeIds, // likewise, and compute rasters the ids
};

// Where light lists are made.
enum class ListPlace : uint8_t { kNowhere, kHost, kDevice };

// What the frame has to work with.
struct FrameFacts {
    // Light flags (shaders/interface/constants.h) of what shines: kLightLocal where any light has
    // a place, kLightSpots, kLightAreas, kLightShadows, kLightEqualRadii, kLightSmallScene,
    // kLightLong, kLightDirectional; and of what is lit: kLightEdges (SceneNeeds::edges).
    uint32_t lights = 0;
    // Output flags of what the G-buffer must hold: kOutputWideGbuffer with its emission's exponent,
    // kOutputSpecular (SceneNeeds).
    uint32_t gbuffer = 0;
    SolidGeometry geometry = SolidGeometry::kRaster;
    ListPlace lists = ListPlace::kHost;
    Outputs outputs = {}; // that are asked for
    PictureForm form = PictureForm::kPixels;
    bool layers_visible = false;       // solid surfaces with layers are drawn by the rasteriser
    bool transparent_visible = false;  // blended surfaces are in view
    bool transmissive_visible = false; // surfaces that light passes as through glass are in view
    bool transmissive_by_ids = false;  // and compute can raster their layers
    bool unlit_solid = false;          // SceneNeeds::unlit
    bool compute_batches = false;      // subgroups fetch lights together in compute
    bool fragment_batches = false;     // and in the fragment stage
    bool culled_batches = false;       // and skip what adds nothing to any of their pixels
    // A workgroup takes as long where nothing covers its pixels, and the host reads where the
    // device writes.
    bool software_device = false;
    bool cull_meshlets = true;     // where ids are drawn
    bool prepass_pays = false;     // drawing depth first costs less than it spares
    bool overdraw_unknown = false; // the scene's was not measured yet
    bool bends = false;            // meshes follow joints or morph targets
    bool operator==(const FrameFacts&) const = default;

    [[nodiscard]] bool hasLight(uint32_t flag) const { return (lights & flag) != 0; }
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

// What becomes of solid surfaces.
enum class Solid : uint8_t {
    kForward,      // they are shaded as they are drawn, or from their ids
    kDeferred,     // they fill a G-buffer, which is lit
    kShownGbuffer, // a debug view shows a G-buffer in the picture's place
    kShownDepth,   // or what needs depth alone
    kFragments,    // or a value of each fragment
};

struct FramePlan {
    Solid solid = Solid::kDeferred;
    SolidGeometry geometry = SolidGeometry::kRaster;
    settings::DebugView debug = settings::DebugView::kNone;
    bool lists = false;             // lights are assigned to clusters
    bool lights_in_compute = false; // solid surfaces' lights are added up there
    bool count_samples = false;     // an occlusion query counts fragments that pass the depth test

    std::vector<PlannedStep> steps = {}; // in their order

    uint32_t forward_light_flags = 0;
    uint32_t lighting_light_flags = 0;
    uint32_t blended_output_flags = 0; // what earlier steps ask of blended surfaces
    uint32_t tone_output_flags = 0;    // how radiance becomes a colour of the display
    uint32_t gbuffer_output_flags = 0;
    // What the shading model, or the G-buffer, has no use for.
    MaterialFlags forward_unused_material_flags = 0;
    MaterialFlags gbuffer_unused_material_flags = 0;
    bool operator==(const FramePlan&) const = default;

    // Null: the frame lacks it.
    [[nodiscard]] const StepPlan* find(const StepRow& row) const;
    // Whether a step that is recorded or reused uses it, from the `first`-th on.
    [[nodiscard]] bool uses(Resource what, size_t first = 0) const;
    // From now on steps that write some of these resources, and nothing else, are reused.
    void reuse(std::span<const Resource> written);
    [[nodiscard]] bool byIds() const { return geometry != SolidGeometry::kRaster; }
};

// What of solid surfaces the next frame may reuse.
inline constexpr std::array kSurfaceResources = {Resource::kDepth, Resource::kIds, Resource::kWords,
                                                 Resource::kGbuffer};

// Whether a step writes some of these, and nothing else.
[[nodiscard]] bool writesOnly(std::span<const Use> uses, std::span<const Resource> these);

// Whether surfaces are shaded as they are drawn, without a G-buffer.
[[nodiscard]] bool isForward(settings::Renderer renderer);
[[nodiscard]] bool isToon(settings::Renderer renderer);

// Whether the G-buffer has a word of what dielectrics reflect.
[[nodiscard]] bool storesSpecular(const settings::ViewSettings& settings, bool scene_specular);

// Whether surfaces with layers, for which the G-buffer has no room, are drawn over the lit ones.
[[nodiscard]] bool drawsLayers(const settings::ViewSettings& settings, bool scene_layers);

// Whether the plan has steps whose surfaces the next frame may reuse.
[[nodiscard]] bool leavesSurfaces(const FramePlan& plan);

// Whether the plan's surfaces are those of the view's frame before.
[[nodiscard]] bool reusesSurfaces(const FramePlan& plan);

// Of a frame.
struct FrameSize {
    settings::Size drawn; // twice the sides of what is shown where pixels have four samples
    settings::Size shown;
    bool operator==(const FrameSize&) const = default;
};
// `settings`: as they are asked for; or with the size that is drawn in place of the one shown.
[[nodiscard]] FrameSize frameSize(const settings::ViewSettings& settings);
[[nodiscard]] FrameSize frameSizeOfDrawn(const settings::ViewSettings& settings);

// `rows`: all steps that there are, in the order of the frame.
[[nodiscard]] FramePlan planFrame(const settings::ViewSettings& settings,
                                  const FrameFacts& facts,
                                  std::span<const StepRow* const> rows);

} // namespace froxel::render
