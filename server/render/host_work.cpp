#include "render/host_work.h"

#include "area_light_table/table.h"
#include "interface/gbuffer_io.h"
#include "render/frame/frame_facts.h"
#include "render/frame/prepass_choice.h"
#include "render/frame/visibility_instances.h"
#include "render/lists/grown_lights.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/steps/order.h"
#include "render/steps/view_steps.h"

#include <algorithm>
#include <future>
#include <memory>
#include <span>
#include <utility>

namespace froxel::render {

namespace {

// Fragments a pixel at least: what was counted is of one view, perhaps of the sky.
constexpr double kUsualOverdraw = 2;

bool storesHalves(const settings::ViewSettings& settings) {
    return !isForward(settings.renderer) &&
           settings.gbuffer.position == settings::PositionSource::kFp16;
}

bool needsLights(settings::DebugView debug) {
    return !settings::replacesPicture(debug) || settings::countsLights(debug) ||
           settings::showsClusters(debug);
}

// As settings, but pixels look lights up in lists whatever was asked for.
settings::ViewSettings withLists(settings::ViewSettings settings) {
    settings.renderer = settings::Renderer::kClusteredDeferred;
    settings.light_loop = settings::LightLoop::kLists;
    return settings;
}

cluster::Lit litBy(const settings::ViewSettings& settings) {
    const bool medium = std::ranges::any_of(kOrder, [&settings](const StepRow* row) {
        return row->lights_medium != nullptr && row->lights_medium(settings);
    });
    return medium ? cluster::Lit::kMedium : cluster::Lit::kSurfaces;
}

bool byIds(GeometryPath path) {
    return path == GeometryPath::kVisibility || path == GeometryPath::kComputeRaster;
}

} // namespace

bool HostWork::choosesVisibility(const FrameInputs& inputs) {
    using settings::LightingStage;
    const auto& traits = scene_.shared.device.traits();
    if (inputs.settings.debug.view == settings::DebugView::kOverdraw) {
        return false; // what a rasteriser draws over is what it shows
    }
    const bool pays =
        inputs.geometry == GeometryPath::kAuto && !traits.is_cpu && traits.descriptor_indexing;
    const auto stage = inputs.settings.lighting;
    // Only the rasteriser writes one, and only it draws layers where lights are added up there.
    const bool second_target =
        extraFormat(inputs.settings.gbuffer,
                    storesSpecular(inputs.settings, pose_.materialSet()->needs.specular)) !=
        vk::Format::eUndefined;
    const bool wanted =
        isForward(inputs.settings.renderer)
            ? stage == LightingStage::kCompute || (stage == LightingStage::kAuto && pays)
            : !second_target && (byIds(inputs.geometry) || pays) &&
                  (stage != LightingStage::kFragment ||
                   !drawsLayers(inputs.settings, pose_.materialSet()->needs.layers));
    return wanted && pose_.materialSet()->visibility_unusable.empty() && pose_.windsAsAtStart() &&
           !pose_.materialSet()->visibility().groups.empty();
}

bool HostWork::choosesComputeRaster(const FrameInputs& inputs) {
    const bool wanted =
        inputs.geometry == GeometryPath::kComputeRaster ||
        (inputs.geometry == GeometryPath::kAuto && !scene_.shared.device.traits().is_cpu);
    return wanted && pose_.materialSet()->visibility().compute_unusable.empty();
}

bool HostWork::prepass(const FrameInputs& inputs) const {
    const bool forward = isForward(inputs.settings.renderer);
    if (inputs.depth_prepass || !scene_.overdraw) {
        return inputs.depth_prepass.value_or(forward);
    }
    const auto& size = inputs.settings.size;
    const double looped =
        light_grid_.lists() ? light_grid_.listLength() : static_cast<double>(lights_.lights.size());
    return prepassPays({.triangle_count = draws_.triangle_count,
                        .pixel_count = uint64_t{size.width_px} * size.height_px,
                        .overdraw = *scene_.overdraw,
                        .lights = forward ? looped : 0.0},
                       scene_.shared.device.traits().is_cpu ? kCpuPrepassCosts : kGpuPrepassCosts);
}

bool HostWork::layersVisible() const {
    const auto has = [](MaterialFlags flags) { return (flags & io::kMaterialLayers) != 0; };
    return visibility_ ? has(pose_.materialSet()->visibility().material_flags)
                       : std::ranges::any_of(draws_.solid, has, &DrawGroup::material_flags);
}

FrameFacts HostWork::facts(const FrameInputs& inputs) const {
    const auto& traits = scene_.shared.device.traits();
    const SurfaceNeeds& needs = pose_.materialSet()->needs;
    const bool lambert = inputs.settings.shading == settings::ShadingModel::kLambert;
    const bool wide = lambert ? needs.wide_lambert : needs.wide_gbuffer;
    const auto flag = [](bool has, uint32_t bit) { return has ? bit : 0U; };
    return {.lights = flag(!lights_.lights.empty(), io::kLightLocal) |
                      flag(!lights_.spots.empty(), io::kLightSpots) |
                      flag(!lights_.areas.empty(), io::kLightAreas) |
                      flag(equalRadii(lights_, inputs.settings.lights), io::kLightEqualRadii) |
                      flag(lights_.nearest_m < light::kNearest_m, io::kLightSmallScene) |
                      flag(traits.is_cpu && longLoops(lists_, lights_, traits.subgroup_size),
                           io::kLightLong) |
                      flag(!lights_.directionals.empty(), io::kLightDirectional) |
                      flag(needs.edges, io::kLightEdges),
            .gbuffer = flag(wide, io::kOutputWideGbuffer | needs.emission_exponent
                                                               << io::kOutputEmissionShift) |
                       flag(needs.specular, io::kOutputSpecular),
            .geometry = compute_raster_ ? SolidGeometry::kComputeIds
                        : visibility_   ? SolidGeometry::kIds
                                        : SolidGeometry::kRaster,
            .lists = !light_grid_.lists() ? ListPlace::kNowhere
                     : on_device_         ? ListPlace::kDevice
                                          : ListPlace::kHost,
            .layers_visible = layersVisible(),
            .transparent_visible = !draws_.transparent.empty(),
            .unlit_solid = needs.unlit,
            .keep_radiance = inputs.keep_radiance,
            .compute_batches = traits.subgroup_size > 1,
            // Elsewhere a subgroup of fragments may lack some of its invocations at any time.
            .fragment_batches = traits.is_cpu && traits.fragment_subgroups,
            // The lights that pass are the bits of one word. In software a lambert light costs less
            // than what would skip it.
            .culled_batches = traits.subgroup_size > 1 && traits.subgroup_size <= 32 &&
                              !(traits.is_cpu && lambert),
            .software_device = traits.is_cpu,
            .cull_meshlets = inputs.cull_meshlets,
            .prepass_pays = prepass(inputs),
            .overdraw_unknown = traits.counts_samples && !scene_.overdraw,
            .bends = scene_.poser() != nullptr};
}

bool HostWork::assignsOnDevice(const FrameInputs& inputs) {
    const bool wanted =
        inputs.assignment == AssignmentPlace::kDevice ||
        (inputs.assignment == AssignmentPlace::kAuto && !scene_.shared.device.traits().is_cpu);
    // Grown lights are assigned, and lists are capped, on the host.
    if (!wanted || inputs.settings.list_cap > 0 || storesHalves(inputs.settings) ||
        !light_grid_.lists() || scene_.shared.assignment() == nullptr) {
        return false;
    }
    const auto& settings = inputs.settings;
    if (settings.lights != refused_.lights || settings.grid != refused_.grid ||
        settings.size != refused_.size) {
        device_lists_.clearRefusal();
    }
    return !device_lists_.refused();
}

bool HostWork::acceptLists(const AssignSlot& lists) {
    const io::AssignTotals totals = lists.totals();
    const bool whole = device_lists_.accept(totals);
    if (const auto tiles = lists.tileLongest();
        !tiles.empty() && totals.outcome != io::kAssignShort) {
        const io::AssignFrame& frame = lists.frame(); // the next one may be prepared
        seen_lists_ = {.grid = {frame.grid_x, frame.grid_y, frame.grid_z},
                       .too_long = totals.outcome == io::kAssignLong,
                       .tile_longest = {tiles.begin(), tiles.end()},
                       .all_lights =
                           totals.entry_count > frame.max_entries ? frame.light_count : 0};
    }
    return whole;
}

const cluster::GridCosts& HostWork::gridCosts(const settings::ViewSettings& settings) const {
    if (scene_.shared.device.traits().is_cpu) {
        return cluster::kCpuCosts;
    }
    const bool in_fragments = isForward(settings.renderer)
                                  ? !visibility_
                                  : settings.lighting == settings::LightingStage::kFragment;
    return in_fragments ? cluster::kGpuFragmentCosts : cluster::kGpuCosts;
}

void HostWork::start(const FrameInputs& inputs, bool in_parts) {
    culling_ = {}; // reads the inputs
    inputs_ = inputs;
    in_parts_ = in_parts;
    cap_.reset();
    assignment_.reset();
    const auto& settings = inputs_.settings;
    pose_.wear(settings.material_variant);
    pose_.standAt(inputs_.time_s, inputs_.playing);
    farthest_m_ = farthestDepth(settings.camera, pose_.boundsWorld());
    projection_ = makeProjection(settings.camera, settings.size, farthest_m_);
    visibility_ = choosesVisibility(inputs_);
    compute_raster_ = visibility_ && choosesComputeRaster(inputs_);
    startCulling();
    evaluation_.reset();
    stage_ = Stage::kLights;
}

// On a CPU device culling and light assignment, which do not need each other, go side by side:
// 7 becomes 5 ms on two cores (Sponza). Elsewhere the host has too little to do for a thread.
void HostWork::startCulling() {
    const bool is_cpu = scene_.shared.device.traits().is_cpu;
    const auto order = inputs_.settings.transparency == settings::Transparency::kSorted
                           ? TransparentOrder::kByDistance
                           : TransparentOrder::kOfTheScene;
    culls_ = {inputs_.settings.camera, inputs_.settings.size, pose_.number(), visibility_, order};
    if (culled_ == culls_) {
        return; // the draw list is a function of them
    }
    culled_.reset();
    ++draw_list_number_;
    culling_ =
        std::async(is_cpu ? std::launch::async : std::launch::deferred, [this, is_cpu, order] {
            const auto& settings = inputs_.settings;
            buildDrawList(scene_, pose_, settings.camera, settings.size, projection_, is_cpu,
                          !visibility_, order, draws_);
            if (visibility_) {
                placeInstances(pose_.instances(), settings.camera, draws_.rows, instances_);
                orderMeshlets(pose_.materialSet()->visibility(), draws_.rows, meshlet_order_);
            }
        });
}

void HostWork::advance(ViewSteps& steps) {
    // Whatever throws ends what was begun.
    switch (*std::exchange(stage_, std::nullopt)) {
    case Stage::kLights:
        stage_ = evaluateMore() ? Stage::kGrid : Stage::kLights;
        break;
    case Stage::kGrid:
        chooseGrid();
        stage_ = Stage::kLists;
        break;
    case Stage::kLists:
        stage_ = !assignMore() ? Stage::kLists : capsLists() ? Stage::kCap : Stage::kPlan;
        break;
    case Stage::kCap:
        stage_ = capMore() ? Stage::kPlan : Stage::kCap;
        break;
    case Stage::kPlan:
        if (culling_.valid()) {
            culling_.get();
            culled_ = culls_;
        }
        plan_ = plan(steps);
        stage_ = Stage::kBuilt;
        break;
    case Stage::kBuilt:
        break;
    }
}

void HostWork::settle() const {
    if (culling_.valid() &&
        culling_.wait_for(std::chrono::seconds(0)) != std::future_status::deferred) {
        culling_.wait();
    }
}

FramePlan HostWork::take() {
    stage_.reset();
    return plan_;
}

const light::FrameLights& HostWork::reach() const {
    return storesHalves(inputs_.settings) ? grown_ : lights_;
}

bool HostWork::evaluateMore() {
    constexpr uint32_t kLightsOfAStage = 100'000;
    if (!evaluation_) {
        beginLights();
    }
    const bool done = evaluation_->advance(in_parts_ ? kLightsOfAStage : UINT32_MAX);
    if (done) {
        evaluation_.reset();
    }
    return done;
}

void HostWork::beginLights() {
    settings::Lights lights = inputs_.settings.lights;
    if (!needsLights(inputs_.settings.debug.view)) {
        lights.count = 0;
        lights.scene_lights = false;
        lights.placed = {};
    }
    evaluation_.emplace(pose_.lightRig(), std::move(lights), inputs_.settings.camera,
                        inputs_.time_s, lights_);
}

void HostWork::chooseGrid() {
    const auto& settings = inputs_.settings;
    if (storesHalves(settings)) {
        growForHalves(lights_, grown_);
    }
    light_grid_.choose(settings::showsClusters(settings.debug.view) ? withLists(settings)
                                                                    : settings,
                       reach(), pose_.boundsWorld(), litBy(settings), gridCosts(settings));
}

uint64_t HostWork::entriesOfAStage() const {
    return in_parts_ ? 2'000'000 : UINT64_MAX;
}

bool HostWork::capMore() {
    if (!cap_) {
        cap_.emplace(light_grid_.grid(), reach(), inputs_.settings.list_cap,
                     scene_.shared.light_assigner.crew(), lists_);
    }
    return cap_->advance(entriesOfAStage());
}

bool HostWork::capsLists() const {
    return inputs_.settings.list_cap > 0 && !on_device_ && light_grid_.lists();
}

bool HostWork::assignMore() {
    const auto& settings = inputs_.settings;
    if (assignment_) {
        return assignment_->advance(entriesOfAStage());
    }
    on_device_ = assignsOnDevice(inputs_);
    if (on_device_) {
        refused_ = settings;
        lists_.clusters.clear();
        lists_.indices.clear();
        lists_.stats = {};
        (void)device_lists_.prepare(light_grid_.grid(), lights_);
    } else if (light_grid_.lists()) {
        if (in_parts_) {
            assignment_.emplace(scene_.shared.light_assigner, light_grid_.grid(), reach(), lists_);
            return assignment_->advance(entriesOfAStage());
        }
        scene_.shared.light_assigner.assign(light_grid_.grid(), reach(), lists_);
    } else {
        lists_.clusters.clear();
        lists_.indices.clear();
        lists_.stats = {};
        lists_.stats.light_count = static_cast<uint32_t>(lights_.lights.size());
        lists_.stats.all_lights = !lights_.lights.empty();
    }
    return true;
}

FramePlan HostWork::plan(ViewSteps& steps) {
    const auto& settings = inputs_.settings;
    lists_.stats.why =
        needsLights(settings.debug.view) ? light_grid_.why() : "the debug view shows no light";
    drawn_ = settings.size;
    FrameFacts found = facts(inputs_);
    steps.look(stepInputs(), found);
    planned_ = generalised(found, inputs_.generic);
    const FramePlan plan = planFrame(settings, planned_, kOrder);
    uniforms_ = makeFrameUniforms(settings, projection_, plan.lists ? &light_grid_.grid() : nullptr,
                                  static_cast<uint32_t>(lights_.lights.size()),
                                  static_cast<uint32_t>(lights_.directionals.size()));
    uniforms_.light_inv_radius2 =
        lights_.lights.empty() ? 0.0F : lights_.lights.front().inv_radius2;
    uniforms_.light_most_inverse2 = static_cast<float>(1 / (lights_.nearest_m * lights_.nearest_m));
    uniforms_.toon_least_middle =
        static_cast<float>(io::kToonMiddle / (lights_.banded_radius_m * lights_.banded_radius_m));
    uniforms_.first_area = lights_.first_area;
    debug_.wires.clear();
    if (plan.debug != settings::DebugView::kNone) {
        buildDebug(inputs_, plan, farthest_m_);
    }
    return plan;
}

std::vector<io::WireVertex> HostWork::buildWires(const FrameInputs& inputs, uint32_t& slice_count) {
    const auto& settings = inputs.settings;
    const LightGrid* shown = &light_grid_;
    settings::Camera camera = settings.debug.grid_camera.value_or(settings.camera);
    if (camera != settings.camera || !light_grid_.lists()) {
        pose_.lightRig().evaluate(settings.lights, camera, inputs.time_s, wire_lights_);
        settings::ViewSettings frozen = withLists(settings);
        frozen.camera = camera;
        wire_grid_.choose(frozen, wire_lights_, pose_.boundsWorld(), litBy(settings),
                          gridCosts(settings));
        shown = &wire_grid_;
    }
    if (!shown->lists()) {
        slice_count = 0;
        return {}; // no light, no clusters
    }
    slice_count = shown->grid().size.z;
    return clusterWires(shown->grid(), camera, settings.camera);
}

void HostWork::buildDebug(const FrameInputs& inputs, const FramePlan& plan, double farthest_m) {
    const auto& settings = inputs.settings;
    DebugFacts facts{.light_count = static_cast<uint32_t>(lights_.lights.size()),
                     .lists = plan.lists,
                     .list_length = light_grid_.lists() ? light_grid_.listLength() : 0.0,
                     .slice_count = light_grid_.lists() ? light_grid_.grid().size.z : 0,
                     .farthest_m = farthest_m};
    if (plan.debug == settings::DebugView::kClusterWires) {
        debug_.wires = buildWires(inputs, facts.slice_count);
    }
    debug_.wire_px = plan.debug == settings::DebugView::kLightSpheres
                         ? lightWirePixels(lights_, settings.camera, settings.size)
                         : wirePixels(debug_.wires, settings.camera, settings.size);
    debug_.light_count = facts.light_count;
    debug_.legend = makeLegend(settings.debug, facts);
    debug_.values = makeDebugValues(settings, pose_.boundsWorld(), debug_.legend,
                                    shownBytes(plan.debug, plan.gbuffer_output_flags));
}

PairBound HostWork::knownPairs(const FramePlan& plan) const {
    if (!plan.lists || on_device_ || lists_.stats.overflowed) {
        return PairBound::uniform(lights_.lights.size());
    }
    return PairBound::lists(light_grid_.grid(), lists_);
}

// With room for what moves between two frames; a frame that has more is drawn again.
std::optional<PairBound> HostWork::seenPairs() const {
    const auto& grid = light_grid_.grid();
    if (!seen_lists_ || seen_lists_->grid != grid.size) {
        return {};
    }
    if (seen_lists_->all_lights > 0) {
        return PairBound::uniform(seen_lists_->all_lights);
    }
    const auto light_count = static_cast<uint32_t>(lights_.lights.size());
    std::vector<uint32_t> longest = seen_lists_->tile_longest;
    for (uint32_t& length : longest) {
        length = std::min(length + length / 4 + 1, light_count);
    }
    return PairBound::tiles(grid, longest);
}

FrameCosts HostWork::costs(const FramePlan& plan,
                           const settings::Size& shown,
                           std::span<const ActiveStep> steps,
                           const UnitCosts& unit,
                           const WorkLimits& work) {
    CostInputs load{.draws = draws_,
                    .drawn = drawn_,
                    .shown = shown,
                    .pairs = knownPairs(plan),
                    .longest_loop = 0,
                    .directional_count = static_cast<uint32_t>(lights_.directionals.size()),
                    .overdraw = std::max(kUsualOverdraw, scene_.overdraw.value_or(0)),
                    .steps = steps};
    const MaterialFlags forward_flags = ~plan.forward_unused_material_flags;
    for (const auto* groups : {&draws_.solid, &draws_.transparent}) {
        for (const DrawGroup& group : *groups) {
            load.lit_surfaces =
                std::max(load.lit_surfaces, litSurfaces(group.material_flags & forward_flags));
        }
    }
    if (!lights_.areas.empty()) {
        load.costly_lights.push_back(
            {.count = static_cast<uint32_t>(lights_.areas.size()), .pair = unit.area_pair});
    }
    for (const ActiveStep& active : steps) {
        active.step->addLoad(unit, load);
    }
    load.longest_loop = load.pairs.longest();
    FrameCosts costs(unit, load);
    if (!on_device_ || costs.total() <= std::min(work.piece, work.loop)) {
        return costs;
    }
    limitLists(costs, work, load);
    return {unit, std::move(load)};
}

void HostWork::limitLists(const FrameCosts& costs, const WorkLimits& work, CostInputs& load) {
    const vk::Rect2D whole{{0, 0}, {drawn_.width_px, drawn_.height_px}};
    const double room = costs.pairsWithin(work.piece);
    const uint64_t longest = costs.lightsWithin(work.loop);
    const double pixels = static_cast<double>(drawn_.width_px) * drawn_.height_px;
    const auto seen = seenPairs();
    if (seen) {
        // What moves between two frames is no reason to refuse the second.
        const uint64_t told = seen_lists_->all_lights > 0
                                  ? seen_lists_->all_lights
                                  : std::ranges::max(seen_lists_->tile_longest);
        load.longest_loop = told <= longest ? std::min(longest, seen->longest()) : seen->longest();
    } else {
        load.longest_loop = std::min(longest, load.longest_loop);
    }
    if (seen &&
        (seen_lists_->too_long || seen->pairs(whole) > room || load.longest_loop > longest)) {
        load.pairs = *seen;
        device_lists_.limit(1.001 * seen->pairs(whole), // floats are summed there
                            std::max(longest, load.longest_loop));
    } else {
        load.pairs = PairBound::uniform(static_cast<uint64_t>(room / pixels));
        device_lists_.limit(room, longest);
    }
}

void HostWork::gather(FrameUpload& upload, std::span<const ActiveStep> steps) {
    upload.clear();
    blocks_ = {};
    const auto place = [&](size_t binding, auto span) {
        blocks_[binding] =
            span.empty() ? FrameBlock{} : FrameBlock{upload.add(span), span.size_bytes()};
    };
    place(io::kFrameBinding, std::span<const io::Frame>(&uniforms_, 1));
    place(io::kLightsBinding, std::span<const io::Light>(lights_.lights));
    place(io::kListsBinding, std::span<const io::ClusterList>(lists_.clusters));
    place(io::kIndicesBinding, std::span<const uint32_t>(lists_.indices));
    place(io::kSpotsBinding, std::span<const io::Spot>(lights_.spots));
    place(io::kSunsBinding, std::span<const io::DirectionalLight>(lights_.directionals));
    place(io::kAreasBinding, std::span<const io::AreaLight>(lights_.areas));
    assign_offsets_ = on_device_ ? gatherAssignment(upload) : AssignOffsets{};
    UploadOffsets& offsets = offsets_;
    offsets = {};
    offsets.rows = upload.add(std::span<const InstanceRows>(draws_.rows));
    std::span<const vk::DrawIndexedIndirectCommand> commands = draws_.commands;
    if (!draws_.indices.empty()) {
        // lavapipe 22.3 ignores an index buffer's offset in indirect draws: count from 0 instead.
        const auto first = upload.add(std::span<const uint32_t>(draws_.indices)) / sizeof(uint32_t);
        placed_commands_ = draws_.commands;
        for (auto& command : placed_commands_) {
            command.firstIndex += static_cast<uint32_t>(first);
        }
        commands = placed_commands_;
    }
    if (visibility_) {
        offsets.instances = upload.add(std::span<const io::InstanceView>(instances_));
        offsets.meshlet_order = upload.add(std::span<const uint32_t>(meshlet_order_));
    }
    offsets.commands = upload.add(commands);
    for (const ActiveStep& active : steps) {
        active.step->gather(upload, blocks_);
    }
}

AssignOffsets HostWork::gatherAssignment(FrameUpload& upload) const {
    const AssignData& data = device_lists_.data();
    return {.frame = upload.add(std::span<const io::AssignFrame>(data.frame)),
            .tables = upload.add(std::span<const double>(data.tables)),
            .lights = blocks_[io::kLightsBinding].offset,
            .radii = upload.add(data.radii_m),
            .spots = upload.add(std::span<const io::AssignSpot>(data.spots))};
}

void HostWork::upload(FrameSlot& slot, std::span<const ActiveStep> steps) {
    slot.upload.commit();
    slot.offsets = offsets_;
    for (const ActiveStep& active : steps) {
        active.step->prepare(slot, blocks_);
    }
    if (!lights_.areas.empty()) {
        const gpu::Buffer& table = scene_.shared.ltcTable();
        blocks_[io::kLtcBinding] = {.bytes = area_light_table::table().size_bytes(),
                                    .buffer = *table.handle};
    }
    slot.device_lists = on_device_;
    if (on_device_) {
        writeAssignment(slot);
    }
    writeFrameSet(scene_.shared.device, slot, blocks_);
}

void HostWork::writeAssignment(FrameSlot& slot) {
    const auto& buffers = device_lists_.makeBuffers();
    blocks_[io::kListsBinding] = {.bytes = device_lists_.data().frame[0].cluster_count *
                                           sizeof(io::ClusterList),
                                  .buffer = *buffers->lists.handle};
    blocks_[io::kIndicesBinding] = {.bytes = uint64_t{buffers->capacity.entries} * sizeof(uint32_t),
                                    .buffer = *buffers->indices.handle};
    if (!slot.assignment) {
        slot.assignment =
            std::make_unique<AssignSlot>(scene_.shared.device, *scene_.shared.assignment());
    }
    slot.assignment->write(buffers, device_lists_.data(), slot.upload.buffer(), assign_offsets_);
}

ListCapacity HostWork::listCapacity() const {
    // Kept for the next frame that has its lists made there.
    return on_device_                ? device_lists_.capacity()
           : device_lists_.buffers() ? device_lists_.buffers()->capacity
                                     : ListCapacity{};
}

uint64_t HostWork::hostBytes() const {
    const auto kept = [](const auto& items) { return items.capacity() * sizeof(items[0]); };
    uint64_t bytes = kept(lists_.clusters) + kept(lists_.indices) + pose_.hostBytes();
    for (const auto* lights : {&lights_, &grown_, &wire_lights_}) {
        bytes += kept(lights->lights) + kept(lights->radii_m) + kept(lights->spots) +
                 kept(lights->cones);
    }
    return bytes;
}

void HostWork::letGo() {
    lists_ = {};
    lights_ = {};
    grown_ = {};
    wire_lights_ = {};
}

} // namespace froxel::render
