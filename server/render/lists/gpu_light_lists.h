// The light lists of one viewer, made on the device: what the host hands over for a frame, the
// memory that frames share, and how it grows. Which pass follows which is in frame_recorder.cpp.
#pragma once

#include "cluster/ball_sweep.h"
#include "cluster/cluster_grid.h"
#include "cluster/light_assigner.h"
#include "core/frame_stats.h"
#include "gpu/memory.h"
#include "interface/assign_io.h"
#include "light/frame_lights.h"
#include "render/lists/assign_pipelines.h"
#include "render/lists/list_limits.h"
#include "render/pipelines/storage_set.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace froxel::render {

struct ListCapacity {
    uint32_t clusters = 0;
    uint32_t entries = 0;
    uint32_t unordered = 0; // of the entries, while they are put in order
    uint32_t tasks = 0;
    bool operator==(const ListCapacity&) const = default;
};

// Counters, and those of tiles.
inline constexpr uint64_t kTotalsBytes =
    sizeof(io::AssignTotals) + io::kAssignMaxTiles * sizeof(uint32_t);
// What one dispatch makes lists of at most: clusters, whose lists come back themselves, and lights,
// which a workgroup goes through in turns.
inline constexpr uint32_t kLineClusters = 8192;
inline constexpr uint32_t kLineLights = 1U << 16U;
inline constexpr uint64_t kListReadbackBytes =
    std::max(kTotalsBytes, kLineClusters * sizeof(io::ClusterList));

// Device memory of the lists. Frames on one queue follow each other, so all of a view share it.
struct ListBuffers;
struct ListPart {
    gpu::Buffer ListBuffers::*buffer;
    const char* name;
    uint64_t bytes;
    vk::BufferUsageFlags usage;
};
[[nodiscard]] std::vector<ListPart> listParts(const ListCapacity& capacity);

struct ListBuffers {
    // Throws vk::OutOfDeviceMemoryError.
    ListBuffers(const gpu::Device& device, const ListCapacity& capacity);

    ListCapacity capacity;
    gpu::MemoryArena arena;
    gpu::Buffer totals;
    gpu::Buffer tasks;
    gpu::Buffer spans;
    gpu::Buffer cursors;
    gpu::Buffer block_sums;
    gpu::Buffer queue;
    gpu::Buffer lists;       // io::ClusterList
    gpu::Buffer raw_indices; // not yet in order
    gpu::Buffer indices;
};

// What the host makes for the device's assignment of one frame.
struct AssignData {
    std::vector<io::AssignFrame> frame; // one
    std::vector<double> tables;
    std::vector<io::AssignSpot> spots;
    std::span<const float> radii_m; // of the lights
    bool in_lines = false;          // one dispatch makes all lists
};

// Where it lies in the frame's upload buffer.
struct AssignOffsets {
    vk::DeviceSize frame = 0;
    vk::DeviceSize tables = 0;
    vk::DeviceSize lights = 0;
    vk::DeviceSize radii = 0;
    vk::DeviceSize spots = 0;
};

// One frame slot's part: its descriptors and the counters that come back.
class AssignSlot {
  public:
    AssignSlot(const gpu::Device& device, const AssignPipelines& pipelines);

    // Describes the slot's upload buffer and `buffers`, which it keeps alive; not in flight.
    void write(std::shared_ptr<ListBuffers> buffers,
               const AssignData& data,
               vk::Buffer upload,
               const AssignOffsets& offsets);

    // The slot is not in flight, and is written before its next frame.
    void letGo() { buffers_.reset(); }

    [[nodiscard]] const ListBuffers& buffers() const { return *buffers_; }
    [[nodiscard]] vk::DescriptorSet set() const { return set_.handle(); }
    [[nodiscard]] vk::Buffer readback() const { return *readback_.handle; }
    // What was written last.
    [[nodiscard]] const io::AssignFrame& frame() const { return frame_; }
    [[nodiscard]] bool inLines() const { return in_lines_; }
    // Whether tiles are looked at.
    [[nodiscard]] uint32_t pricedTiles() const {
        return frame_.max_pairs > 0 ? frame_.grid_x * frame_.grid_y : 0;
    }
    // Of the last frame, which has completed.
    [[nodiscard]] io::AssignTotals totals() const;
    // Likewise the longest list of each tile; empty where they were not looked at.
    [[nodiscard]] std::span<const uint32_t> tileLongest() const;

  private:
    gpu::MemoryArena arena_;
    gpu::Buffer readback_;
    StorageSet set_;
    std::shared_ptr<ListBuffers> buffers_;
    io::AssignFrame frame_{};
    bool in_lines_ = false;
};

class GpuLightLists {
  public:
    GpuLightLists(const gpu::Device& device, const ListLimits& limits);

    // Prepares a frame's data for memory that holds what frames so far have needed. `lights` must
    // stay alive until the data is uploaded.
    const AssignData& prepare(const cluster::ClusterGrid& grid, const light::FrameLights& lights);
    // Of what was prepared: how many (light, pixel) pairs the frame may evaluate, and how long a
    // list may be.
    void limit(double pairs, uint64_t longest);
    [[nodiscard]] const AssignData& data() const { return data_; }
    // What the frame prepared last finds room for.
    [[nodiscard]] const ListCapacity& capacity() const { return capacity_; }
    // That memory. Throws vk::OutOfDeviceMemoryError.
    [[nodiscard]] const std::shared_ptr<ListBuffers>& makeBuffers();
    [[nodiscard]] const std::shared_ptr<ListBuffers>& buffers() const { return buffers_; }

    // After a frame: whether its lists are whole. If not they have none and the frame must be drawn
    // again, for which the next prepare() makes room.
    [[nodiscard]] bool accept(const io::AssignTotals& totals);
    // Whether a frame asked for more tasks than may be: the host must assign its like.
    [[nodiscard]] bool refused() const { return refused_; }
    void clearRefusal() { refused_ = false; }

  private:
    // How the lists of data_ are made, and what room they find.
    void choosePasses();

    const gpu::Device& device_;
    ListLimits limits_;
    cluster::BallSweep sweep_;
    AssignData data_;
    std::shared_ptr<ListBuffers> buffers_;
    ListCapacity capacity_;
    ListCapacity wanted_;
    bool refused_ = false;
};

// As the host's assigner states them.
[[nodiscard]] LightListStats
listStats(const io::AssignTotals& totals, uint32_t light_count, uint32_t cluster_count);

} // namespace froxel::render
