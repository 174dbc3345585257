#include "render/frame/frame_plan.h"

#include "interface/constants.h"
#include "interface/gbuffer_io.h"
#include "render/pipelines/gbuffer_layout.h"

#include <algorithm>
#include <cstddef>

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
    if (facts.hasLight(io::kLightLocal)) {
        constexpr uint32_t kOthers =
            io::kLightShadows | io::kLightTransmitted | io::kLightDirectional | io::kLightEdges;
        flags |= facts.lights & ~kOthers;
        flags |= lists ? io::kLightLists | sliceFlags(settings.grid.law) : 0U;
        if (compute) {
            flags |= facts.compute_batches ? io::kLightBatched : 0U;
        } else {
            flags |= facts.fragment_batches ? io::kLightBatched | io::kLightPartial : 0U;
        }
        // All lights stay the plain loop: what lists are measured and tested against.
        const bool culled = lists && facts.culled_batches && !facts.hasLight(io::kLightLong);
        flags |= culled && (flags & io::kLightBatched) != 0 ? io::kLightCulled : 0U;
    }
    flags |= facts.lights & io::kLightDirectional;
    flags |= flags != 0 ? toonFlags(settings) : 0U;
    flags |= shadingFlag(settings.shading);
    flags |=
        settings.shading != settings::ShadingModel::kLambert ? facts.lights & io::kLightEdges : 0U;
    return flags;
}

Solid solidOf(const settings::ViewSettings& settings, const FrameFacts& facts) {
    const settings::DebugView debug = settings.debug.view;
    const bool forward = isForward(settings.renderer);
    if (!settings::replacesPicture(debug)) {
        return forward ? Solid::kForward : Solid::kDeferred;
    }
    if (settings::showsFragments(debug)) {
        return Solid::kFragments;
    }
    // Depths that compute rasters are exact once the G-buffer is filled.
    return !forward || settings::showsMaterial(debug) ||
                   facts.geometry == SolidGeometry::kComputeIds
               ? Solid::kShownGbuffer
               : Solid::kShownDepth;
}

// Where solid surfaces are lit. Lights are added up fastest in compute; but light from around alone
// takes as long in either stage, and the fragment stage has none of it where nothing is drawn.
bool lightsInCompute(const settings::ViewSettings& settings,
                     const FrameFacts& facts,
                     const FramePlan& plan) {
    using settings::LightingStage;
    if (plan.solid == Solid::kForward) {
        return plan.byIds();
    }
    if (plan.solid != Solid::kDeferred) {
        return false;
    }
    if (settings.lighting != LightingStage::kAuto) {
        return settings.lighting == LightingStage::kCompute;
    }
    return !facts.software_device || facts.hasLight(io::kLightLocal) ||
           settings.environment.light == settings::EnvironmentLight::kOff;
}

// What surfaces and lights are drawn as, whatever the steps.
FramePlan planVariants(const settings::ViewSettings& settings, const FrameFacts& facts) {
    FramePlan plan{.solid = solidOf(settings, facts),
                   .geometry = facts.geometry,
                   .debug = settings.debug.view};
    const bool replaced = settings::replacesPicture(plan.debug);
    const bool local = facts.hasLight(io::kLightLocal);
    plan.lists = local && facts.lists != ListPlace::kNowhere &&
                 (replaced ? (settings::showsClusters(plan.debug) ||
                              (settings::countsLights(plan.debug) &&
                               settings.renderer != settings::Renderer::kNaive))
                           : (settings.renderer != settings::Renderer::kNaive ||
                              settings::showsClusters(plan.debug)));
    plan.lights_in_compute = lightsInCompute(settings, facts, plan);
    plan.count_samples = facts.overdraw_unknown && !plan.byIds() && plan.solid != Solid::kFragments;
    plan.forward_light_flags = lightFlags(settings, facts, plan.lists, false);
    plan.lighting_light_flags = lightFlags(settings, facts, plan.lists, plan.lights_in_compute);
    plan.tone_output_flags = settings.tone_map == settings::ToneMap::kClamp ? io::kOutputClamp : 0U;
    if (plan.solid == Solid::kDeferred || plan.solid == Solid::kShownGbuffer) {
        // A forward renderer's, for a debug view: the default.
        const settings::GbufferLayout layout =
            isForward(settings.renderer) ? settings::GbufferLayout{} : settings.gbuffer;
        const bool specular = storesSpecular(settings, (facts.gbuffer & io::kOutputSpecular) != 0);
        plan.gbuffer_output_flags = (facts.gbuffer & ~uint32_t{io::kOutputSpecular}) |
                                    (specular ? io::kOutputSpecular : 0U) | layoutFlags(layout);
    }
    plan.gbuffer_unused_material_flags = kLayerFlags;
    if (settings.shading == settings::ShadingModel::kLambert) {
        plan.forward_unused_material_flags = kLayerFlags & ~kTransmissionFlags;
        plan.gbuffer_unused_material_flags |=
            textureFlag(io::metallic_roughness_slot) | kSpecularFlags;
    }
    return plan;
}

// Of a pixel that is shown; a debug view in the picture's place has one.
uint32_t samplesAcross(const settings::ViewSettings& settings) {
    return settings::replacesPicture(settings.debug.view)
               ? 1
               : settings::samplesAcross(settings.antialiasing);
}

void findUses(const FramePlan& plan, PlannedStep& step) {
    if (step.row->uses != nullptr) {
        step.uses = step.row->uses(plan, step.plan);
    }
}

// Who packs pixels, and where: through every filter that follows, one after another.
void placePixels(FramePlan& plan) {
    std::vector<StepPlan*> filters;
    StepPlan* packer = nullptr;
    size_t packer_index = 0;
    for (size_t i = 0; i < plan.steps.size(); ++i) {
        StepPlan& step = plan.steps[i].plan;
        if (step.filters) {
            filters.push_back(&step);
        } else if (step.can_pack) {
            packer = &step;
            packer_index = i;
        }
    }
    if (packer == nullptr) {
        return; // a plan of some rows alone
    }
    packer->leaves_radiance = plan.uses(Resource::kRadiance, packer_index + 1);
    StepPlan* from = packer;
    for (size_t i = 0; i < filters.size(); ++i) {
        const Resource between = i % 2 == 0 ? Resource::kDisplay : Resource::kDisplay2;
        from->packs = filters[i]->packed = between;
        from = filters[i];
    }
    from->packs = Resource::kPixels;
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

const StepPlan* FramePlan::find(const StepRow& row) const {
    const auto at = std::ranges::find(steps, &row, &PlannedStep::row);
    return at != steps.end() ? &at->plan : nullptr;
}

bool FramePlan::uses(Resource what, size_t first) const {
    return std::any_of(steps.begin() + static_cast<std::ptrdiff_t>(first), steps.end(),
                       [what](const PlannedStep& step) { return step.touches(what); });
}

bool writesOnly(std::span<const Use> uses, std::span<const Resource> these) {
    const auto outside = [&](const Use& use) {
        return writes(use) && std::ranges::find(these, use.what) == these.end();
    };
    return std::ranges::any_of(uses, writes) && std::ranges::none_of(uses, outside);
}

void FramePlan::reuse(std::span<const Resource> written) {
    for (PlannedStep& step : steps) {
        step.reused |= writesOnly(step.uses, written);
    }
}

bool leavesSurfaces(const FramePlan& plan) {
    return !plan.count_samples && std::ranges::any_of(plan.steps, [](const PlannedStep& step) {
        return writesOnly(step.uses, kSurfaceResources);
    });
}

bool reusesSurfaces(const FramePlan& plan) {
    return std::ranges::any_of(plan.steps, [](const PlannedStep& step) {
        return step.reused && writesOnly(step.uses, kSurfaceResources);
    });
}

FrameFacts generalised(FrameFacts facts, const GenericParts& parts) {
    const auto alter = [&facts](bool there, uint32_t add, uint32_t remove) {
        facts.lights = there ? (facts.lights | add) & ~remove : facts.lights;
    };
    alter(parts.spots && facts.hasLight(io::kLightLocal), io::kLightSpots, 0);
    alter(parts.directional, io::kLightDirectional, 0);
    alter(parts.uneven_radii, 0, io::kLightEqualRadii);
    facts.gbuffer |= parts.wide_gbuffer ? io::kOutputWideGbuffer : 0U;
    facts.transparent_visible |= parts.transparent;
    facts.compute_batches &= !parts.plain_loops;
    facts.fragment_batches &= !parts.plain_loops;
    facts.culled_batches &= !parts.uncut_loops;
    return facts;
}

FrameSize frameSize(const settings::ViewSettings& settings) {
    const uint32_t across = samplesAcross(settings);
    const settings::Size& shown = settings.size;
    return {.drawn = {shown.width_px * across, shown.height_px * across}, .shown = shown};
}

FrameSize frameSizeOfDrawn(const settings::ViewSettings& settings) {
    const uint32_t across = samplesAcross(settings);
    const settings::Size& drawn = settings.size;
    return {.drawn = drawn, .shown = {drawn.width_px / across, drawn.height_px / across}};
}

FramePlan planFrame(const settings::ViewSettings& settings,
                    const FrameFacts& facts,
                    std::span<const StepRow* const> rows) {
    FramePlan plan = planVariants(settings, facts);
    const bool replaced = settings::replacesPicture(plan.debug);
    for (const StepRow* row : rows) {
        if (replaced && row->part == StepPart::kPicture) {
            continue;
        }
        if (const auto step = row->plan({settings, facts, plan})) {
            plan.forward_light_flags |= step->light_flags;
            plan.lighting_light_flags |= step->light_flags;
            plan.blended_output_flags |= step->blended_output_flags;
            plan.steps.push_back({.row = row, .plan = *step});
            findUses(plan, plan.steps.back()); // for the plans of those that follow
        }
    }
    placePixels(plan);
    for (PlannedStep& step : plan.steps) {
        findUses(plan, step);
    }
    return plan;
}

} // namespace froxel::render
