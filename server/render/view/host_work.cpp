#include "render/view/host_work.h"

#include "interface/gbuffer_io.h"
#include "render/frame/frame_facts.h"
#include "render/frame/prepass_choice.h"
#include "render/frame/view_targets.h"
#include "render/steps/order.h"
#include "render/steps/transmission_targets.h"
#include "render/steps/view_steps.h"

#include <algorithm>
#include <utility>

namespace froxel::render {

namespace {

// Fragments a pixel at least: what was counted is of one view, perhaps of the sky.
constexpr double kUsualOverdraw = 2;

} // namespace

void HostWork::start(const FrameInputs& inputs, bool in_parts) {
    culling_.abandon();
    inputs_ = inputs;
    const auto& settings = inputs_.settings;
    pose_.wear(settings.material_variant);
    pose_.standAt(inputs_.time_s, inputs_.playing);
    farthest_m_ = farthestDepth(settings.camera, pose_.boundsWorld());
    projection_ = makeProjection(settings.camera, settings.size, farthest_m_);
    culling_.start(inputs_, pose_, projection_);
    light_work_.start(inputs_, pose_, culling_.geometry(), in_parts);
    stage_ = Stage::kLights;
}

void HostWork::advance(ViewSteps& steps) {
    // Whatever throws ends what was begun.
    switch (*std::exchange(stage_, std::nullopt)) {
    case Stage::kLights:
        stage_ = light_work_.advance() ? Stage::kPlan : Stage::kLights;
        break;
    case Stage::kPlan:
        culling_.finish();
        plan_ = plan(steps);
        stage_ = Stage::kBuilt;
        break;
    case Stage::kBuilt:
        stage_ = Stage::kBuilt;
        break;
    }
}

FramePlan HostWork::take() {
    stage_.reset();
    return std::exchange(plan_, {});
}

bool HostWork::prepassPays() const {
    const FrameInputs& inputs = inputs_;
    const bool forward = isForward(inputs.settings.renderer);
    if (inputs.depth_prepass || !scene_.overdraw) {
        return inputs.depth_prepass.value_or(forward);
    }
    const auto& size = inputs.settings.size;
    return render::prepassPays({.triangle_count = culling_.draws().triangle_count,
                                .pixel_count = uint64_t{size.width_px} * size.height_px,
                                .overdraw = *scene_.overdraw,
                                .lights = forward ? light_work_.looped() : 0.0},
                               scene_.shared.device.traits().is_cpu ? kCpuPrepassCosts
                                                                    : kGpuPrepassCosts);
}

bool HostWork::layersVisible() const {
    const auto has = [](MaterialFlags flags) { return (flags & io::kMaterialLayers) != 0; };
    return culling_.geometry() != SolidGeometry::kRaster
               ? has(pose_.materialSet()->solid_flags)
               : std::ranges::any_of(culling_.draws().solid, has, &DrawGroup::material_flags);
}

bool HostWork::transmissiveByIds() const {
    const auto& settings = inputs_.settings;
    const vk::DeviceSize most_words = kWordBytes * mostLayers(settings) * settings.size.width_px *
                                      vk::DeviceSize{settings.size.height_px};
    if (culling_.geometry() != SolidGeometry::kComputeIds ||
        culling_.draws().transmissive.groups.empty() ||
        most_words > scene_.shared.device.limits().maxStorageBufferRange) {
        return false;
    }
    MaterialSet& materials = *pose_.materialSet();
    const Detail detail = scene_.detailOf(settings.geometry_error_px);
    return materials.visibilityUnusable(detail, Surfaces::kTransmissive).empty() &&
           materials.visibility(detail, Surfaces::kTransmissive).compute_unusable.empty();
}

uint32_t HostWork::lightFacts() const {
    const auto& traits = scene_.shared.device.traits();
    const auto& lights = light_work_.lights();
    const auto flag = [](bool has, uint32_t bit) { return has ? bit : 0U; };
    return flag(!lights.lights.empty(), io::kLightLocal) |
           flag(!lights.spots.empty(), io::kLightSpots) |
           flag(!lights.areas.empty(), io::kLightAreas) |
           flag(equalRadii(lights, inputs_.settings.lights), io::kLightEqualRadii) |
           flag(lights.nearest_m < light::kNearest_m, io::kLightSmallScene) |
           flag(traits.is_cpu && longLoops(light_work_.lists(), lights, traits.subgroup_size),
                io::kLightLong) |
           flag(!lights.directionals.empty(), io::kLightDirectional) |
           flag(pose_.materialSet()->needs.edges, io::kLightEdges);
}

FrameFacts HostWork::facts() const {
    const auto& traits = scene_.shared.device.traits();
    const SurfaceNeeds& needs = pose_.materialSet()->needs;
    const bool lambert = inputs_.settings.shading == settings::ShadingModel::kLambert;
    const bool wide = lambert ? needs.wide_lambert : needs.wide_gbuffer;
    const auto flag = [](bool has, uint32_t bit) { return has ? bit : 0U; };
    return {.lights = lightFacts(),
            .gbuffer = flag(wide, io::kOutputWideGbuffer | needs.emission_exponent
                                                               << io::kOutputEmissionShift) |
                       flag(needs.specular, io::kOutputSpecular),
            .geometry = culling_.geometry(),
            .lists = light_work_.place(),
            .outputs = inputs_.outputs,
            .form = inputs_.form.kind(),
            .layers_visible = layersVisible(),
            .transparent_visible = !culling_.draws().transparent.groups.empty(),
            .transmissive_visible = !culling_.draws().transmissive.groups.empty(),
            .transmissive_by_ids = transmissiveByIds(),
            .unlit_solid = needs.unlit,
            .compute_batches = traits.subgroup_size > 1,
            // Elsewhere a subgroup of fragments may lack some of its invocations at any time.
            .fragment_batches = traits.is_cpu && traits.fragment_subgroups,
            // The lights that pass are the bits of one word. In software a lambert light costs less
            // than what would skip it.
            .culled_batches = traits.subgroup_size > 1 && traits.subgroup_size <= 32 &&
                              !(traits.is_cpu && lambert),
            .software_device = traits.is_cpu,
            .cull_meshlets = inputs_.cull_meshlets,
            .prepass_pays = prepassPays(),
            .overdraw_unknown = traits.counts_samples && !scene_.overdraw,
            .bends = scene_.poser() != nullptr};
}

FramePlan HostWork::plan(ViewSteps& steps) {
    FrameFacts found = facts();
    steps.look(stepInputs(), found);
    planned_ = generalised(found, inputs_.generic);
    const FramePlan plan = planFrame(inputs_.settings, planned_, kOrder);
    buildUniforms(plan);
    debug_.wires.clear();
    if (plan.debug != settings::DebugView::kNone) {
        buildDebug(plan);
    }
    return plan;
}

void HostWork::buildUniforms(const FramePlan& plan) {
    const auto& lights = light_work_.lights();
    uniforms_ = makeFrameUniforms(inputs_.settings, projection_,
                                  plan.lists ? &light_work_.grid().grid() : nullptr,
                                  static_cast<uint32_t>(lights.lights.size()),
                                  static_cast<uint32_t>(lights.directionals.size()));
    uniforms_.light_inv_radius2 = lights.lights.empty() ? 0.0F : lights.lights.front().inv_radius2;
    uniforms_.light_most_inverse2 = static_cast<float>(1 / (lights.nearest_m * lights.nearest_m));
    uniforms_.toon_least_middle =
        static_cast<float>(io::kToonMiddle / (lights.banded_radius_m * lights.banded_radius_m));
    uniforms_.first_area = lights.first_area;
}

void HostWork::buildDebug(const FramePlan& plan) {
    const auto& settings = inputs_.settings;
    const auto& lights = light_work_.lights();
    const LightGrid& grid = light_work_.grid();
    DebugFacts facts{.light_count = static_cast<uint32_t>(lights.lights.size()),
                     .lists = plan.lists,
                     .list_length = grid.lists() ? grid.listLength() : 0.0,
                     .slice_count = grid.lists() ? grid.grid().size.z : 0,
                     .farthest_m = farthest_m_};
    if (plan.debug == settings::DebugView::kClusterWires) {
        debug_.wires = light_work_.wires(facts.slice_count);
    }
    debug_.wire_px = plan.debug == settings::DebugView::kLightSpheres
                         ? lightWirePixels(lights, settings.camera, settings.size)
                         : wirePixels(debug_.wires, settings.camera, settings.size);
    debug_.light_count = facts.light_count;
    debug_.legend = makeLegend(settings.debug, facts);
    debug_.values = makeDebugValues(settings, pose_.boundsWorld(), debug_.legend,
                                    shownBytes(plan.debug, plan.gbuffer_output_flags));
}

FrameCosts HostWork::costs(const FramePlan& plan,
                           const FrameSize& size,
                           std::span<const ActiveStep> steps,
                           const UnitCosts& unit,
                           const WorkLimits& work) {
    const DrawList& draws = culling_.draws();
    const auto& lights = light_work_.lights();
    CostInputs load{.draws = draws,
                    .size = size,
                    .pairs = light_work_.knownPairs(plan.lists),
                    .longest_loop = 0,
                    .directional_count = static_cast<uint32_t>(lights.directionals.size()),
                    .overdraw = std::max(kUsualOverdraw, scene_.overdraw.value_or(0)),
                    .steps = steps};
    const MaterialFlags forward_flags = ~plan.forward_unused_material_flags;
    for (const auto* groups :
         {&draws.solid, &draws.transparent.groups, &draws.transmissive.groups}) {
        for (const DrawGroup& group : *groups) {
            load.lit_surfaces =
                std::max(load.lit_surfaces, litSurfaces(group.material_flags & forward_flags));
        }
    }
    if (!lights.areas.empty()) {
        load.costly_lights.push_back(
            {.count = static_cast<uint32_t>(lights.areas.size()), .pair = unit.area_pair});
    }
    for (const ActiveStep& active : steps) {
        active.step->addLoad(unit, load);
    }
    load.longest_loop = load.pairs.longest();
    FrameCosts costs(unit, load);
    if (light_work_.place() != ListPlace::kDevice ||
        costs.total() <= std::min(work.piece, work.loop)) {
        return costs;
    }
    light_work_.limit(costs, work, load);
    return {unit, std::move(load)};
}

void HostWork::gather(FrameUpload& upload, std::span<const ActiveStep> steps) {
    upload.clear();
    blocks_ = {};
    offsets_ = {};
    blocks_[io::kFrameBinding] = {upload.add(std::span<const io::Frame>(&uniforms_, 1)),
                                  sizeof(uniforms_)};
    light_work_.gather(upload, blocks_);
    culling_.gather(upload, offsets_);
    for (const ActiveStep& active : steps) {
        active.step->gather(upload, blocks_);
    }
}

void HostWork::upload(FrameSlot& slot, std::span<const ActiveStep> steps) {
    slot.upload.commit();
    slot.offsets = offsets_;
    light_work_.prepare(slot, blocks_);
    for (const ActiveStep& active : steps) {
        active.step->prepare(slot, blocks_);
    }
    writeFrameSet(scene_.shared.device, slot, blocks_);
}

} // namespace froxel::render
