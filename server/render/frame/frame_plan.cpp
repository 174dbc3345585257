#include "render/frame/frame_plan.h"

#include "interface/constants.h"
#include "interface/gbuffer_io.h"
#include "render/pipelines/gbuffer_layout.h"

#include <algorithm>

namespace froxel::render {

namespace {

uint32_t sliceFlags(settings::GridLaw law) {
    switch (law) {
    case settings::GridLaw::kLogarithmic:
        return 0;
    case settings::GridLaw::kLinear:
        return io::kLightSlicesLinear;
    case settings::GridLaw::kHyperbolic:
        return io::kLightSlicesHyperbolic;
    }
    return 0;
}

uint32_t shadingFlag(settings::ShadingModel model) {
    switch (model) {
    case settings::ShadingModel::kPbr:
        return 0;
    case settings::ShadingModel::kLambert:
        return io::kLightLambert;
    case settings::ShadingModel::kBlinnPhong:
        return io::kLightBlinnPhong;
    }
    return 0;
}

// Of a frame with lights.
uint32_t toonFlags(const settings::ViewSettings& settings) {
    if (!isToon(settings.renderer)) {
        return 0;
    }
    const settings::Toon& toon = settings.toon;
    uint32_t flags = toon.rim > 0 && toon.rim_width > 0 ? io::kLightRim : 0U;
    if (settings.renderer == settings::Renderer::kToonFragment) {
        flags |= io::kLightToon | (toon.bands > 0 ? io::kLightBands : 0U);
    }
    return flags;
}

uint32_t lightFlags(const settings::ViewSettings& settings,
                    const FrameFacts& facts,
                    bool lists,
                    bool compute) {
    uint32_t flags = 0;
    if (facts.local_lights) {
        flags |= io::kLightLocal;
        flags |= lists ? io::kLightLists | sliceFlags(settings.grid.law) : 0U;
        flags |= facts.spots ? io::kLightSpots : 0U;
        flags |= facts.areas ? io::kLightAreas : 0U;
        flags |= facts.equal_radii ? io::kLightEqualRadii : 0U;
        flags |= facts.small_scene ? io::kLightSmallScene : 0U;
        flags |= facts.long_loops ? io::kLightLong : 0U;
        if (compute) {
            flags |= facts.compute_batches ? io::kLightBatched : 0U;
        } else {
            flags |= facts.fragment_batches ? io::kLightBatched | io::kLightPartial : 0U;
        }
        // All lights stay the plain loop: what lists are measured and tested against.
        const bool culled = lists && facts.culled_batches && !facts.long_loops;
        flags |= culled && (flags & io::kLightBatched) != 0 ? io::kLightCulled : 0U;
    }
    flags |= facts.directional ? io::kLightDirectional : 0U;
    flags |= flags != 0 ? toonFlags(settings) : 0U;
    flags |= shadingFlag(settings.shading);
    flags |=
        facts.edges && settings.shading != settings::ShadingModel::kLambert ? io::kLightEdges : 0U;
    return flags;
}

// A debug view in the picture's place: the surfaces that it shows, and no lighting.
void replacePicture(FramePlan& plan,
                    const settings::ViewSettings& settings,
                    const FrameFacts& facts) {
    const settings::DebugView debug = settings.debug.view;
    const bool overdraw = debug == settings::DebugView::kOverdraw;
    // Depths that compute rasters are exact once the G-buffer is filled.
    plan.gbuffer = !overdraw && (!isForward(settings.renderer) || settings::showsMaterial(debug) ||
                                 plan.compute_raster);
    plan.depth_prepass &= plan.gbuffer;
    plan.depth_prepass |= !overdraw && !plan.gbuffer && !plan.visibility;
    plan.count_samples = facts.overdraw_unknown && !overdraw && !plan.visibility;
    plan.forward = plan.visibility_shade = false;
    plan.lighting_compute = plan.lighting_fragment = plan.layers = false;
    plan.toon_pass = plan.transparent = false;
    plan.transparency = settings::Transparency::kSorted;
    plan.peel_layers = 0;
    plan.over_unlit = false;
    plan.outline = plan.samples = false; // nothing is done to what it shows
    std::erase_if(plan.effects,
                  [](const auto& it) { return it.row->place != EffectPlace::kLights; });
    plan.lists &= settings::countsLights(debug) || settings::showsClusters(debug);
}

} // namespace

bool isForward(settings::Renderer renderer) {
    return renderer == settings::Renderer::kNaive || renderer == settings::Renderer::kForwardPlus;
}

bool isToon(settings::Renderer renderer) {
    return renderer == settings::Renderer::kToonFragment ||
           renderer == settings::Renderer::kToonCompute;
}

bool storesSpecular(const settings::ViewSettings& settings, bool scene_specular) {
    return scene_specular && !isForward(settings.renderer) &&
           settings.shading != settings::ShadingModel::kLambert;
}

bool drawsLayers(const settings::ViewSettings& settings, bool scene_layers) {
    return scene_layers && !isForward(settings.renderer) &&
           settings.shading != settings::ShadingModel::kLambert;
}

bool leavesSurfaces(const FramePlan& plan) {
    return (plan.visibility || plan.gbuffer || plan.depth_prepass) && !plan.count_samples &&
           plan.debug != settings::DebugView::kOverdraw;
}

bool FramePlan::hasEffect(EffectPlace place) const {
    return std::ranges::any_of(effects, [place](const auto& it) { return it.row->place == place; });
}

FrameFacts generalised(FrameFacts facts, const GenericParts& parts) {
    facts.spots |= parts.spots && facts.local_lights;
    facts.directional |= parts.directional;
    facts.wide_gbuffer |= parts.wide_gbuffer;
    facts.transparent_visible |= parts.transparent;
    facts.equal_radii &= !parts.uneven_radii;
    facts.compute_batches &= !parts.plain_loops;
    facts.fragment_batches &= !parts.plain_loops;
    facts.culled_batches &= !parts.uncut_loops;
    return facts;
}

settings::Size drawnSize(const settings::ViewSettings& settings) {
    const uint32_t across = settings::replacesPicture(settings.debug.view)
                                ? 1
                                : settings::samplesAcross(settings.antialiasing);
    return {settings.size.width_px * across, settings.size.height_px * across};
}

namespace {

// Where a G-buffer is lit. Lights are added up fastest in compute; but light from around alone
// takes as long in either stage, and the fragment stage has none of it where nothing is drawn.
bool lightsInCompute(const settings::ViewSettings& settings, const FrameFacts& facts) {
    using settings::LightingStage;
    if (settings.lighting != LightingStage::kAuto) {
        return settings.lighting == LightingStage::kCompute;
    }
    return !facts.whole_groups || facts.local_lights ||
           settings.environment.light == settings::EnvironmentLight::kOff;
}

// Which passes there are.
FramePlan planPasses(const settings::ViewSettings& settings, const FrameFacts& facts) {
    using settings::Renderer;
    FramePlan plan;
    const Renderer renderer = settings.renderer;
    plan.pose = facts.bends;
    plan.visibility = facts.visibility;
    plan.compute_raster = facts.visibility && facts.compute_raster;
    plan.visibility_shade = facts.visibility && isForward(renderer);
    plan.cull_meshlets = facts.cull_meshlets;
    plan.forward = isForward(renderer) && !plan.visibility_shade;
    plan.gbuffer = !isForward(renderer);
    const bool rastered = plan.forward || (plan.gbuffer && !plan.visibility);
    plan.depth_prepass = rastered && renderer != Renderer::kNaive && facts.prepass_pays;
    plan.count_samples = rastered && facts.overdraw_unknown;
    plan.lighting_compute = plan.gbuffer && lightsInCompute(settings, facts);
    plan.lighting_fragment = plan.gbuffer && !plan.lighting_compute;
    plan.layers = drawsLayers(settings, facts.layers_visible);
    plan.toon_pass = renderer == Renderer::kToonCompute;
    plan.toon_bands = plan.toon_pass && settings.toon.bands > 0;
    plan.outline = isToon(renderer) && settings.toon_outline.strength > 0;
    plan.samples = settings::samplesAcross(settings.antialiasing) > 1;
    for (const EffectRow* row : effectRows()) {
        if (const auto effect = row->plan(settings, facts)) {
            plan.effects.push_back({row, *effect});
        }
    }
    plan.transparent = facts.transparent_visible;
    if (plan.transparent) {
        plan.transparency = settings.transparency;
        plan.over_unlit = facts.unlit_solid;
        plan.peel_layers =
            settings.transparency == settings::Transparency::kPeeled ? settings.peel_layers : 0;
    }
    plan.debug = settings.debug.view;
    plan.lists = (renderer != Renderer::kNaive || settings::showsClusters(plan.debug)) &&
                 facts.local_lights && !facts.all_lights;
    plan.count_pairs = settings.count_pairs && facts.local_lights;

    if (settings::replacesPicture(plan.debug)) {
        replacePicture(plan, settings, facts);
    }
    return plan;
}

} // namespace

FramePlan planFrame(const settings::ViewSettings& settings, const FrameFacts& facts) {
    FramePlan plan = planPasses(settings, facts);

    // The last pass that touches a solid pixel also exposes and packs it, unless more follows.
    const bool compute_lights = plan.lighting_compute || plan.visibility_shade;
    const bool follows = plan.layers || plan.transparent || plan.outline || plan.samples ||
                         plan.hasEffect(EffectPlace::kSolid) ||
                         plan.hasEffect(EffectPlace::kPicture) || settings::isOverlay(plan.debug);
    const bool compute_ends = !follows && (compute_lights || plan.toon_pass);
    plan.tonemap = !compute_ends && !settings::replacesPicture(plan.debug);
    plan.radiance = plan.tonemap || plan.toon_pass || facts.keep_radiance ||
                    plan.debug == settings::DebugView::kOverdraw;

    plan.forward_light_flags = lightFlags(settings, facts, plan.lists, false);
    plan.lighting_light_flags = lightFlags(settings, facts, plan.lists, compute_lights);

    for (const auto& [row, effect] : plan.effects) {
        plan.forward_light_flags |= effect.light_flags;
        plan.lighting_light_flags |= effect.light_flags;
        plan.blended_output_flags |= effect.blended_output_flags;
    }

    const uint32_t wide = facts.wide_gbuffer
                              ? io::kOutputWideGbuffer | facts.emission_exponent
                                                             << io::kOutputEmissionShift
                              : 0U;
    plan.tone_output_flags = settings.tone_map == settings::ToneMap::kClamp ? io::kOutputClamp : 0U;
    const uint32_t pixels = io::kOutputPixels | plan.tone_output_flags;
    const settings::GbufferLayout layout = // a forward renderer's, for a debug view: the default
        isForward(settings.renderer) ? settings::GbufferLayout{} : settings.gbuffer;
    const uint32_t specular = storesSpecular(settings, facts.specular) ? io::kOutputSpecular : 0U;
    plan.gbuffer_output_flags = plan.gbuffer ? wide | specular | layoutFlags(layout) : 0U;
    plan.lighting_output_flags = plan.gbuffer_output_flags;
    plan.gbuffer_unused_material_flags = kLayerFlags;
    if (settings.shading == settings::ShadingModel::kLambert) {
        plan.forward_unused_material_flags = kLayerFlags;
        plan.gbuffer_unused_material_flags |=
            textureFlag(io::metallic_roughness_slot) | kSpecularFlags;
    }
    if (compute_lights) {
        plan.lighting_output_flags |= plan.radiance ? io::kOutputRadiance : 0U;
        plan.lighting_output_flags |= compute_ends && !plan.toon_pass ? pixels : 0U;
    }
    if (plan.toon_pass) {
        plan.toon_output_flags |= compute_ends ? pixels : 0U;
        plan.toon_output_flags |= plan.tonemap || facts.keep_radiance ? io::kOutputRadiance : 0U;
    }
    plan.tonemap_output_flags = plan.tone_output_flags | (plan.samples ? io::kOutputSamples : 0U);
    return plan;
}

} // namespace froxel::render
