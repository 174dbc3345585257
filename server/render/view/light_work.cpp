#include "render/view/light_work.h"

#include "area_light_table/table.h"
#include "render/lists/grown_lights.h"
#include "render/steps/order.h"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

namespace froxel::render {

namespace {

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

} // namespace

void LightWork::start(const FrameInputs& inputs,
                      const ScenePose& pose,
                      SolidGeometry geometry,
                      bool in_parts) {
    inputs_ = &inputs;
    pose_ = &pose;
    geometry_ = geometry;
    in_parts_ = in_parts;
    cap_.reset();
    assignment_.reset();
    evaluation_.reset();
    stage_ = Stage::kLights;
}

bool LightWork::advance() {
    switch (stage_) {
    case Stage::kLights:
        stage_ = evaluateMore() ? Stage::kGrid : Stage::kLights;
        break;
    case Stage::kGrid:
        chooseGrid();
        stage_ = Stage::kLists;
        break;
    case Stage::kLists:
        if (assignMore()) {
            const bool caps = inputs_->settings.list_cap > 0 && place() == ListPlace::kHost;
            stage_ = caps ? Stage::kCap : Stage::kDone;
        }
        break;
    case Stage::kCap:
        stage_ = capMore() ? Stage::kDone : Stage::kCap;
        break;
    case Stage::kDone:
        break;
    }
    return stage_ == Stage::kDone;
}

const light::FrameLights& LightWork::reach() const {
    return storesHalves(inputs_->settings) ? grown_ : lights_;
}

const cluster::GridCosts& LightWork::gridCosts() const {
    const settings::ViewSettings& settings = inputs_->settings;
    if (scene_.shared.device.traits().is_cpu) {
        return cluster::kCpuCosts;
    }
    const bool in_fragments = isForward(settings.renderer)
                                  ? geometry_ == SolidGeometry::kRaster
                                  : settings.lighting == settings::LightingStage::kFragment;
    return in_fragments ? cluster::kGpuFragmentCosts : cluster::kGpuCosts;
}

bool LightWork::evaluateMore() {
    constexpr uint32_t kLightsOfAStage = 100'000;
    if (!evaluation_) {
        settings::Lights lights = inputs_->settings.lights;
        if (!needsLights(inputs_->settings.debug.view)) {
            lights.count = 0;
            lights.scene_lights = false;
            lights.placed = {};
        }
        evaluation_.emplace(pose_->lightRig(), std::move(lights), inputs_->settings.camera,
                            inputs_->time_s, lights_);
    }
    const bool done = evaluation_->advance(in_parts_ ? kLightsOfAStage : UINT32_MAX);
    if (done) {
        evaluation_.reset();
    }
    return done;
}

void LightWork::chooseGrid() {
    const auto& settings = inputs_->settings;
    if (storesHalves(settings)) {
        growForHalves(lights_, grown_);
    }
    grid_.choose(settings::showsClusters(settings.debug.view) ? withLists(settings) : settings,
                 reach(), pose_->boundsWorld(), litBy(settings), gridCosts());
}

bool LightWork::assignsOnDevice() {
    const FrameInputs& inputs = *inputs_;
    const bool wanted =
        inputs.assignment == AssignmentPlace::kDevice ||
        (inputs.assignment == AssignmentPlace::kAuto && !scene_.shared.device.traits().is_cpu);
    // Grown lights are assigned, and lists are capped, on the host.
    if (!wanted || inputs.settings.list_cap > 0 || storesHalves(inputs.settings) ||
        !grid_.lists() || scene_.shared.assignment() == nullptr) {
        return false;
    }
    const auto& settings = inputs.settings;
    if (settings.lights != refused_.lights || settings.grid != refused_.grid ||
        settings.size != refused_.size) {
        device_lists_.clearRefusal();
    }
    return !device_lists_.refused();
}

bool LightWork::assignMore() {
    const auto& settings = inputs_->settings;
    if (assignment_) {
        return assignment_->advance(entriesOfAStage());
    }
    on_device_ = assignsOnDevice();
    if (on_device_) {
        refused_ = settings;
        lists_.clusters.clear();
        lists_.indices.clear();
        lists_.stats = {};
        (void)device_lists_.prepare(grid_.grid(), lights_);
    } else if (grid_.lists()) {
        if (in_parts_) {
            assignment_.emplace(scene_.shared.light_assigner, grid_.grid(), reach(), lists_);
            return assignment_->advance(entriesOfAStage());
        }
        scene_.shared.light_assigner.assign(grid_.grid(), reach(), lists_);
    } else {
        lists_.clusters.clear();
        lists_.indices.clear();
        lists_.stats = {};
        lists_.stats.light_count = static_cast<uint32_t>(lights_.lights.size());
        lists_.stats.all_lights = !lights_.lights.empty();
    }
    return true;
}

bool LightWork::capMore() {
    if (!cap_) {
        cap_.emplace(grid_.grid(), reach(), inputs_->settings.list_cap,
                     scene_.shared.light_assigner.crew(), lists_);
    }
    return cap_->advance(entriesOfAStage());
}

LightListStats LightWork::stats() const {
    LightListStats stats = lists_.stats;
    stats.why =
        needsLights(inputs_->settings.debug.view) ? grid_.why() : "the debug view shows no light";
    return stats;
}

std::vector<io::WireVertex> LightWork::wires(uint32_t& slice_count) {
    const auto& settings = inputs_->settings;
    const LightGrid* shown = &grid_;
    settings::Camera camera = settings.debug.grid_camera.value_or(settings.camera);
    if (camera != settings.camera || !grid_.lists()) {
        pose_->lightRig().evaluate(settings.lights, camera, inputs_->time_s, wire_lights_);
        settings::ViewSettings frozen = withLists(settings);
        frozen.camera = camera;
        wire_grid_.choose(frozen, wire_lights_, pose_->boundsWorld(), litBy(settings), gridCosts());
        shown = &wire_grid_;
    }
    if (!shown->lists()) {
        slice_count = 0;
        return {}; // no light, no clusters
    }
    slice_count = shown->grid().size.z;
    return clusterWires(shown->grid(), camera, settings.camera);
}

PairBound LightWork::knownPairs(bool lists) const {
    if (!lists || on_device_ || lists_.stats.overflowed) {
        return PairBound::uniform(lights_.lights.size());
    }
    return PairBound::lists(grid_.grid(), lists_);
}

// With room for what moves between two frames; a frame that has more is drawn again.
std::optional<PairBound> LightWork::seenPairs() const {
    const auto& grid = grid_.grid();
    if (!seen_ || seen_->grid != grid.size) {
        return {};
    }
    if (seen_->all_lights > 0) {
        return PairBound::uniform(seen_->all_lights);
    }
    const auto light_count = static_cast<uint32_t>(lights_.lights.size());
    std::vector<uint32_t> longest = seen_->tile_longest;
    for (uint32_t& length : longest) {
        length = std::min(length + length / 4 + 1, light_count);
    }
    return PairBound::tiles(grid, longest);
}

void LightWork::limit(const FrameCosts& costs, const WorkLimits& work, CostInputs& load) {
    const vk::Rect2D whole{{0, 0}, {load.size.drawn.width_px, load.size.drawn.height_px}};
    const double room = costs.pairsWithin(work.piece);
    const uint64_t longest = costs.lightsWithin(work.loop);
    const double pixels = static_cast<double>(load.size.drawn.width_px) * load.size.drawn.height_px;
    const auto seen = seenPairs();
    if (seen) {
        // What moves between two frames is no reason to refuse the second.
        const uint64_t told =
            seen_->all_lights > 0 ? seen_->all_lights : std::ranges::max(seen_->tile_longest);
        load.longest_loop = told <= longest ? std::min(longest, seen->longest()) : seen->longest();
    } else {
        load.longest_loop = std::min(longest, load.longest_loop);
    }
    if (seen && (seen_->too_long || seen->pairs(whole) > room || load.longest_loop > longest)) {
        load.pairs = *seen;
        device_lists_.limit(1.001 * seen->pairs(whole), // floats are summed there
                            std::max(longest, load.longest_loop));
    } else {
        load.pairs = PairBound::uniform(static_cast<uint64_t>(room / pixels));
        device_lists_.limit(room, longest);
    }
}

bool LightWork::accept(const AssignSlot& lists) {
    const io::AssignTotals totals = lists.totals();
    const bool whole = device_lists_.accept(totals);
    if (const auto tiles = lists.tileLongest();
        !tiles.empty() && totals.outcome != io::kAssignShort) {
        const io::AssignFrame& frame = lists.frame(); // the next one may be prepared
        seen_ = {.grid = {frame.grid_x, frame.grid_y, frame.grid_z},
                 .too_long = totals.outcome == io::kAssignLong,
                 .tile_longest = {tiles.begin(), tiles.end()},
                 .all_lights = totals.entry_count > frame.max_entries ? frame.light_count : 0};
    }
    return whole;
}

void LightWork::gather(FrameUpload& upload, FrameBlocks& blocks) {
    const auto place = [&](size_t binding, auto span) {
        blocks[binding] =
            span.empty() ? FrameBlock{} : FrameBlock{upload.add(span), span.size_bytes()};
    };
    place(io::kLightsBinding, std::span<const io::Light>(lights_.lights));
    place(io::kListsBinding, std::span<const io::ClusterList>(lists_.clusters));
    place(io::kIndicesBinding, std::span<const uint32_t>(lists_.indices));
    place(io::kSpotsBinding, std::span<const io::Spot>(lights_.spots));
    place(io::kSunsBinding, std::span<const io::DirectionalLight>(lights_.directionals));
    place(io::kAreasBinding, std::span<const io::AreaLight>(lights_.areas));
    assign_offsets_ = {};
    if (on_device_) {
        const AssignData& data = device_lists_.data();
        assign_offsets_ = {.frame = upload.add(std::span<const io::AssignFrame>(data.frame)),
                           .tables = upload.add(std::span<const double>(data.tables)),
                           .lights = blocks[io::kLightsBinding].offset,
                           .radii = upload.add(data.radii_m),
                           .spots = upload.add(std::span<const io::AssignSpot>(data.spots))};
    }
}

void LightWork::prepare(FrameSlot& slot, FrameBlocks& blocks) {
    if (!lights_.areas.empty()) {
        blocks[io::kLtcBinding] = {.bytes = area_light_table::table().size_bytes(),
                                   .buffer = *scene_.shared.ltcTable().handle};
    }
    slot.device_lists = on_device_;
    if (!on_device_) {
        return;
    }
    const auto& buffers = device_lists_.makeBuffers();
    blocks[io::kListsBinding] = {.bytes = device_lists_.data().frame[0].cluster_count *
                                          sizeof(io::ClusterList),
                                 .buffer = *buffers->lists.handle};
    blocks[io::kIndicesBinding] = {.bytes = uint64_t{buffers->capacity.entries} * sizeof(uint32_t),
                                   .buffer = *buffers->indices.handle};
    if (!slot.assignment) {
        slot.assignment =
            std::make_unique<AssignSlot>(scene_.shared.device, *scene_.shared.assignment());
    }
    slot.assignment->write(buffers, device_lists_.data(), slot.upload.buffer(), assign_offsets_);
}

ListCapacity LightWork::capacity() const {
    // Kept for the next frame that has its lists made there.
    return on_device_                ? device_lists_.capacity()
           : device_lists_.buffers() ? device_lists_.buffers()->capacity
                                     : ListCapacity{};
}

uint64_t LightWork::hostBytes() const {
    const auto kept = [](const auto& items) { return items.capacity() * sizeof(items[0]); };
    uint64_t bytes = kept(lists_.clusters) + kept(lists_.indices);
    for (const auto* lights : {&lights_, &grown_, &wire_lights_}) {
        bytes += kept(lights->lights) + kept(lights->radii_m) + kept(lights->spots) +
                 kept(lights->cones);
    }
    return bytes;
}

void LightWork::letGo() {
    lists_ = {};
    lights_ = {};
    grown_ = {};
    wire_lights_ = {};
}

} // namespace froxel::render
