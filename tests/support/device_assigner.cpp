#include "support/device_assigner.h"

#include "render/frame/frame_slot.h"
#include "render/lists/assign_passes.h"
#include "render/pipelines/host_copies.h"

#include <gtest/gtest.h>

#include <cstring>

namespace froxel::test {

namespace {

// Past this, growth does not converge.
constexpr uint32_t kMaxAttempts = 5;

template <class T>
std::vector<T> readBack(const gpu::Buffer& buffer, size_t count) {
    std::vector<T> values(count);
    std::memcpy(values.data(), buffer.mapped, count * sizeof(T));
    return values;
}

// Lists that one dispatch made lie apart: moves them together.
void closeUp(cluster::LightLists& lists) {
    std::vector<uint32_t> together;
    for (io::ClusterList& list : lists.clusters) {
        const auto first = lists.indices.begin() + list.offset;
        list.offset = static_cast<uint32_t>(together.size());
        together.insert(together.end(), first, first + list.count);
    }
    lists.indices = std::move(together);
}

} // namespace

struct DeviceAssigner::Impl {
    Impl(gpu::Device& device_in, const render::ListLimits& limits)
        : device(device_in), timeline(device_in), pipelines(device_in), timestamps(device_in),
          lists(device_in, limits), slot(device_in, pipelines), upload(device_in) {}

    void run(const cluster::ClusterGrid& grid, const light::FrameLights& lights);
    cluster::LightLists fetch(const cluster::ClusterGrid& grid, size_t light_count);

    gpu::Device& device;
    gpu::Timeline timeline;
    render::AssignPipelines pipelines;
    gpu::Timestamps timestamps;
    render::GpuLightLists lists;
    render::AssignSlot slot;
    render::FrameUpload upload;
    uint32_t attempts = 0;
};

void DeviceAssigner::Impl::run(const cluster::ClusterGrid& grid, const light::FrameLights& lights) {
    const render::AssignData& data = lists.prepare(grid, lights);
    upload.clear();
    const render::AssignOffsets offsets{
        .frame = upload.add(std::span<const io::AssignFrame>(data.frame)),
        .tables = upload.add(std::span<const double>(data.tables)),
        .lights = upload.add(std::span<const io::Light>(lights.lights)),
        .radii = upload.add(data.radii_m),
        .spots = upload.add(std::span<const io::AssignSpot>(data.spots))};
    upload.commit();
    slot.write(lists.makeBuffers(), data, upload.buffer(), offsets);
    timestamps.reset();
    timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        render::recordAssignment({cmd, pipelines, slot}, timestamps);
        render::recordHostRead(cmd);
    });
}

cluster::LightLists DeviceAssigner::Impl::fetch(const cluster::ClusterGrid& grid,
                                                size_t light_count) {
    const io::AssignTotals totals = slot.totals();
    cluster::LightLists out;
    out.stats = render::listStats(totals, static_cast<uint32_t>(light_count), grid.clusterCount());
    out.all_lights = out.stats.overflowed;
    const size_t index_count = out.all_lights   ? light_count
                               : slot.inLines() ? grid.clusterCount() * light_count
                                                : totals.entry_count;
    gpu::MemoryArena arena(device);
    const auto usage = vk::BufferUsageFlagBits::eTransferDst;
    const auto list_copy = arena.makeBuffer(grid.clusterCount() * sizeof(io::ClusterList), usage,
                                            gpu::MemoryUse::kReadback, "lists");
    const auto index_copy = arena.makeBuffer(index_count * sizeof(uint32_t), usage,
                                             gpu::MemoryUse::kReadback, "indices");
    timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        cmd.copyBuffer(*slot.buffers().lists.handle, *list_copy.handle,
                       vk::BufferCopy{.size = grid.clusterCount() * sizeof(io::ClusterList)});
        if (index_count > 0) {
            cmd.copyBuffer(*slot.buffers().indices.handle, *index_copy.handle,
                           vk::BufferCopy{.size = index_count * sizeof(uint32_t)});
        }
        render::recordHostRead(cmd);
    });
    out.clusters = readBack<io::ClusterList>(list_copy, grid.clusterCount());
    out.indices = readBack<uint32_t>(index_copy, index_count);
    if (slot.inLines()) {
        closeUp(out);
    }
    return out;
}

DeviceAssigner::DeviceAssigner(gpu::Device& device, const render::ListLimits& limits)
    : impl_(std::make_unique<Impl>(device, limits)) {}

DeviceAssigner::~DeviceAssigner() = default;

cluster::LightLists DeviceAssigner::assign(const cluster::ClusterGrid& grid,
                                           const light::FrameLights& lights) {
    for (impl_->attempts = 1; impl_->attempts <= kMaxAttempts; ++impl_->attempts) {
        impl_->run(grid, lights);
        if (impl_->lists.accept(impl_->slot.totals())) {
            return impl_->fetch(grid, lights.lights.size());
        }
        if (impl_->lists.refused()) {
            return {};
        }
    }
    ADD_FAILURE() << "the lists never fitted";
    return {};
}

uint32_t DeviceAssigner::attempts() const {
    return impl_->attempts;
}

bool DeviceAssigner::refused() const {
    return impl_->lists.refused();
}

bool DeviceAssigner::inLines() const {
    return impl_->slot.inLines();
}

} // namespace froxel::test
