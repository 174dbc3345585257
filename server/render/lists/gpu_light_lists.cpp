#include "render/lists/gpu_light_lists.h"

#include "cluster/list_histogram.h"
#include "cluster/spot_cut.h"
#include "core/assert.h"
#include "gpu/pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace froxel::render {

namespace {

using Usage = vk::BufferUsageFlagBits;

// Room for the lights to move before lists must grow again.
uint32_t withMargin(uint64_t needed) {
    return static_cast<uint32_t>(std::min<uint64_t>(needed + needed / 2, UINT32_MAX));
}

uint32_t blocksOf(uint32_t clusters) {
    return (clusters + io::kAssignScanBlock - 1) / io::kAssignScanBlock;
}

io::AssignSpot makeSpot(const light::FrameLights& lights, const io::Light& light, float radius_m) {
    const glm::dvec3 apex(light.position_view.x, -light.position_view.y, -light.position_view.z);
    io::AssignSpot spot{};
    const auto cut =
        cluster::SpotCut::make(apex, glm::dvec3(lights.spots[light.spot].direction_view),
                               lights.cones[light.spot], static_cast<double>(radius_m));
    if (cut) {
        spot.cone = cut->cone();
        spot.cut = 1;
        if (std::isfinite(radius_m)) {
            spot.bound = cut->bound();
        }
    }
    return spot;
}

} // namespace

std::vector<ListPart> listParts(const ListCapacity& capacity) {
    constexpr uint64_t kWord = sizeof(uint32_t);
    const uint64_t clusters = capacity.clusters;
    const uint64_t entries = std::max(capacity.entries, 1U);
    const uint64_t unordered = std::max(capacity.unordered, 1U);
    const uint64_t tasks = std::max(capacity.tasks, 1U);
    return {
        {&ListBuffers::totals, "light list counters", kTotalsBytes,
         Usage::eIndirectBuffer | Usage::eTransferDst | Usage::eTransferSrc},
        {&ListBuffers::tasks, "light assignment tasks", tasks * sizeof(io::AssignTask), {}},
        {&ListBuffers::spans, "light assignment spans", tasks * io::kAssignTaskLines * kWord, {}},
        {&ListBuffers::cursors, "light list cursors", clusters * kWord, Usage::eTransferDst},
        {&ListBuffers::block_sums, "light list sums", blocksOf(capacity.clusters) * kWord, {}},
        {&ListBuffers::queue, "light list queue", clusters * kWord, {}},
        {&ListBuffers::lists, "light lists", clusters * sizeof(io::ClusterList),
         Usage::eUniformTexelBuffer | Usage::eTransferSrc},
        {&ListBuffers::raw_indices, "light indices, unordered", unordered * kWord, {}},
        {&ListBuffers::indices, "light indices", entries * kWord,
         Usage::eUniformTexelBuffer | Usage::eTransferSrc}};
}

ListBuffers::ListBuffers(const gpu::Device& device, const ListCapacity& capacity_in)
    : capacity(capacity_in), arena(device) {
    for (const auto& [buffer, name, bytes, usage] : listParts(capacity)) {
        this->*buffer =
            arena.makeBuffer(bytes, Usage::eStorageBuffer | usage, gpu::MemoryUse::kDevice, name);
    }
}

AssignSlot::AssignSlot(const gpu::Device& device, const AssignPipelines& pipelines)
    : arena_(device), readback_(arena_.makeBuffer(kListReadbackBytes,
                                                  Usage::eTransferDst,
                                                  gpu::MemoryUse::kReadback,
                                                  "light list counters")),
      set_(device, pipelines.setLayout(), AssignPipelines::kBindings) {
    static_assert(uint64_t{settings::kGridXRange.max} * settings::kGridYRange.max <=
                  io::kAssignMaxTiles);
}

void AssignSlot::write(std::shared_ptr<ListBuffers> buffers,
                       const AssignData& data,
                       vk::Buffer upload,
                       const AssignOffsets& offsets) {
    buffers_ = std::move(buffers);
    const io::AssignFrame& frame = frame_ = data.frame[0];
    in_lines_ = data.in_lines;
    const auto part = [&](vk::DeviceSize offset, vk::DeviceSize bytes) {
        return vk::DescriptorBufferInfo{upload, offset, std::max<vk::DeviceSize>(bytes, 16)};
    };
    const auto whole = [](const gpu::Buffer& buffer) {
        return vk::DescriptorBufferInfo{*buffer.handle, 0, VK_WHOLE_SIZE};
    };
    const ListBuffers& b = *buffers_;
    const std::array<vk::DescriptorBufferInfo, AssignPipelines::kBindings> infos = {
        part(offsets.frame, sizeof(io::AssignFrame)),
        part(offsets.tables, data.tables.size() * sizeof(double)),
        part(offsets.lights, uint64_t{frame.light_count} * sizeof(io::Light)),
        part(offsets.radii, data.radii_m.size_bytes()),
        part(offsets.spots, data.spots.size() * sizeof(io::AssignSpot)),
        whole(b.totals),
        whole(b.tasks),
        whole(b.spans),
        whole(b.cursors),
        whole(b.block_sums),
        whole(b.queue),
        whole(b.lists),
        whole(b.raw_indices),
        whole(b.indices)};
    set_.write(infos);
}

io::AssignTotals AssignSlot::totals() const {
    if (!in_lines_) {
        return *reinterpret_cast<const io::AssignTotals*>(readback_.mapped);
    }
    io::AssignTotals totals{};
    const auto* lists = reinterpret_cast<const io::ClusterList*>(readback_.mapped);
    for (const io::ClusterList& list : std::span(lists, frame_.cluster_count)) {
        totals.entry_count += list.count;
        totals.largest = std::max(totals.largest, list.count);
        ++totals.histogram[io::histogramBucket(list.count)];
    }
    return totals;
}

std::span<const uint32_t> AssignSlot::tileLongest() const {
    const auto* words =
        reinterpret_cast<const uint32_t*>(readback_.mapped + sizeof(io::AssignTotals));
    return {words, pricedTiles()};
}

GpuLightLists::GpuLightLists(const gpu::Device& device, const ListLimits& limits)
    : device_(device),
      limits_(limits), wanted_{.entries = limits.first_entries, .tasks = limits.first_tasks} {
    // Shaders read the lists as texels.
    limits_.max_entries = std::min<uint64_t>(
        {limits_.max_entries, device.limits().maxTexelBufferElements,
         device.limits().maxStorageBufferRange / sizeof(uint32_t), io::kScanSaturated - 1});
}

const AssignData& GpuLightLists::prepare(const cluster::ClusterGrid& grid,
                                         const light::FrameLights& lights) {
    const auto light_count = static_cast<uint32_t>(lights.lights.size());
    FROXEL_ASSERT(lights.radii_m.size() == light_count, "a radius for each light");
    sweep_.prepare(grid);
    data_.tables.clear();
    const auto append = [&](const std::vector<double>& values) {
        data_.tables.insert(data_.tables.end(), values.begin(), values.end());
    };
    append(sweep_.planeDepths());
    append(sweep_.inversePlaneDepths());
    append(sweep_.rowEdges());
    append(sweep_.rowNorms());
    for (uint32_t i = 0; i <= grid.usedColumns(); ++i) {
        data_.tables.push_back(grid.columnEdge(i));
    }
    data_.spots.resize(lights.spots.size());
    for (size_t i = 0; i < light_count && !lights.spots.empty(); ++i) {
        const io::Light& light = lights.lights[i];
        if (light.spot != io::kNoSpot) {
            data_.spots[light.spot] = makeSpot(lights, light, lights.radii_m[i]);
        }
    }
    data_.radii_m = lights.radii_m;
    data_.frame.assign(
        1, {.columns = sweep_.columns(),
            .rows = sweep_.rows(),
            .grid_x = grid.size.x,
            .grid_y = grid.size.y,
            .grid_z = grid.size.z,
            .used_columns = grid.usedColumns(),
            .used_rows = grid.usedRows(),
            .perspective = grid.projection == settings::Projection::kPerspective ? 1U : 0U,
            .light_count = light_count,
            .cluster_count = grid.clusterCount(),
            .index_capacity = 0,
            .task_capacity = 0,
            .max_entries = static_cast<uint32_t>(limits_.max_entries),
            .max_pairs = 0,
            .max_list = UINT32_MAX,
            .image_width_px = grid.image.width_px,
            .image_height_px = grid.image.height_px,
            .tile_width_px = grid.tile_width_px,
            .tile_height_px = grid.tile_height_px});
    choosePasses();
    return data_;
}

void GpuLightLists::limit(double pairs, uint64_t longest) {
    data_.frame[0].max_pairs = static_cast<float>(pairs);
    data_.frame[0].max_list = static_cast<uint32_t>(std::min<uint64_t>(longest, UINT32_MAX));
    choosePasses();
}

void GpuLightLists::choosePasses() {
    io::AssignFrame& frame = data_.frame[0];
    const uint64_t all_entries = uint64_t{frame.cluster_count} * frame.light_count;
    // Lists that have room for all can neither run over nor be refused for what they cost.
    data_.in_lines = limits_.line_entries > 0 && frame.max_pairs == 0 &&
                     frame.cluster_count <= kLineClusters && frame.light_count <= kLineLights &&
                     all_entries <= std::min<uint64_t>(limits_.line_entries, limits_.max_entries);
    const ListCapacity had = buffers_ ? buffers_->capacity : ListCapacity{};
    capacity_ = had;
    const auto hold = [](uint32_t& room, uint64_t needed) {
        room = std::max(room, static_cast<uint32_t>(needed));
    };
    hold(capacity_.clusters, frame.cluster_count);
    if (data_.in_lines) {
        hold(capacity_.entries, all_entries);
    } else {
        // Also holds the list of all lights.
        const uint32_t entries = std::max(wanted_.entries, frame.light_count);
        hold(capacity_.entries, entries);
        hold(capacity_.unordered, entries);
        hold(capacity_.tasks, wanted_.tasks);
    }
    frame.index_capacity = std::min(capacity_.entries, capacity_.unordered);
    frame.task_capacity = capacity_.tasks;
}

const std::shared_ptr<ListBuffers>& GpuLightLists::makeBuffers() {
    if (!buffers_ || buffers_->capacity != capacity_) {
        // Frames in flight keep the old ones alive through their slots.
        buffers_.reset();
        buffers_ = std::make_shared<ListBuffers>(device_, capacity_);
    }
    return buffers_;
}

bool GpuLightLists::accept(const io::AssignTotals& totals) {
    if (totals.outcome == io::kAssignLong) {
        return false;
    }
    if (totals.outcome != io::kAssignShort) {
        return true;
    }
    if (totals.task_count > limits_.max_tasks) {
        refused_ = true;
        return false;
    }
    wanted_.tasks =
        std::max(wanted_.tasks, std::min(withMargin(totals.task_count), limits_.max_tasks));
    // Short of tasks, the entries were counted in part: enough for what is known.
    const uint64_t entries = std::min<uint64_t>(totals.entry_count, limits_.max_entries);
    wanted_.entries = std::max(wanted_.entries, static_cast<uint32_t>(std::min<uint64_t>(
                                                    withMargin(entries), limits_.max_entries)));
    return false;
}

LightListStats
listStats(const io::AssignTotals& totals, uint32_t light_count, uint32_t cluster_count) {
    LightListStats stats;
    stats.light_count = light_count;
    stats.cluster_count = cluster_count;
    if (totals.outcome == io::kAssignAllLights) {
        stats.entry_count = uint64_t{light_count} * cluster_count;
        stats.largest = light_count;
        stats.p95 = light_count;
        stats.overflowed = true;
    } else {
        cluster::ListHistogram lengths;
        for (uint32_t bucket = 0; bucket < io::kHistogramBuckets; ++bucket) {
            lengths.addBucket(bucket, totals.histogram[bucket]);
        }
        stats.empty_count = totals.histogram[0];
        stats.entry_count = totals.entry_count;
        stats.largest = totals.largest;
        stats.p95 = lengths.p95(totals.largest);
    }
    const uint32_t filled = cluster_count - stats.empty_count;
    stats.mean = filled > 0 ? static_cast<double>(stats.entry_count) / filled : 0.0;
    const uint64_t indices = stats.overflowed ? light_count : stats.entry_count;
    stats.bytes = uint64_t{cluster_count} * sizeof(io::ClusterList) + indices * sizeof(uint32_t);
    return stats;
}

} // namespace froxel::render
