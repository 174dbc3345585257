// The chosen Vulkan device, its queues and what it can do.
#pragma once

#include "gpu/device_options.h"
#include "gpu/instance.h"
#include "gpu/memory_ledger.h"
#include "gpu/pipeline_cache.h"
#include "gpu/vulkan.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace froxel::gpu {

// What the renderer adapts to.
struct DeviceTraits {
    std::string name;
    std::string driver;
    uint32_t api_version = 0;
    bool is_cpu = false;        // a software rasteriser: host memory is its memory
    uint32_t subgroup_size = 0; // 0: lacks vote, ballot, arithmetic or shuffle in compute
    bool fragment_subgroups = false;
    bool draw_indirect_count = false;
    bool descriptor_indexing = false; // shaders pick a texture for each invocation
    std::string visibility_lacks;     // features that the visibility passes miss; empty: none
    bool float64 = false;             // doubles in shaders
    bool int64_atomics = false;       // on 64-bit words of storage buffers
    bool counts_samples = false;      // precise occlusion queries
    double timestamp_period_ns = 1;
    float max_anisotropy = 1;
    uint32_t most_textures = 0; // images and texel buffers that a shader stage may read
    uint32_t most_samplers = 0; // and those of the images with samplers of their own
};

struct Queue {
    vk::raii::Queue handle{nullptr};
    uint32_t family = 0;
};

class Device {
  public:
    // Throws StartupError(kDevice) naming what is missing.
    explicit Device(const DeviceOptions& options);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();

    [[nodiscard]] const vk::raii::Device& handle() const { return device_; }
    [[nodiscard]] const vk::raii::PhysicalDevice& physical() const { return physical_; }
    // Draws, computes and copies.
    [[nodiscard]] const Queue& queue() const { return queue_; }
    // Copies beside it; null: there is none.
    [[nodiscard]] const Queue* copyQueue() const { return copy_queue_ ? &*copy_queue_ : nullptr; }
    [[nodiscard]] const DeviceTraits& traits() const { return traits_; }
    [[nodiscard]] const vk::PhysicalDeviceLimits& limits() const { return limits_; }
    [[nodiscard]] const ValidationLog& validationLog() const { return instance_.validationLog(); }
    [[nodiscard]] const vk::PhysicalDeviceMemoryProperties& memory() const { return memory_; }
    [[nodiscard]] const vk::raii::PipelineCache& pipelineCache() const { return cache_; }
    // Writes to disk what was compiled since the last time, if anything; also done at the end. A
    // folder that cannot be written is no failure: one line in the log.
    void savePipelineCache();
    // Of every MemoryArena; shared with them, since some outlive their owners.
    [[nodiscard]] const std::shared_ptr<MemoryLedger>& memoryLedger() const { return ledger_; }

    // Names an object for the validation layer and for captures; nothing without validation.
    template <class Handle>
    void setName(const Handle& handle, std::string_view name) const {
        using CType = typename Handle::CType;
        nameObject(Handle::objectType, reinterpret_cast<uint64_t>(static_cast<CType>(handle)),
                   name);
    }
    [[nodiscard]] bool labels() const { return instance_.validating(); }

  private:
    void loadPipelineCache(const PipelineCacheOptions& options);
    void nameObject(vk::ObjectType type, uint64_t handle, std::string_view name) const;

    Instance instance_;
    vk::raii::PhysicalDevice physical_{nullptr};
    vk::raii::Device device_{nullptr};
    Queue queue_;
    std::optional<Queue> copy_queue_;
    vk::raii::PipelineCache cache_{nullptr};
    PipelineCacheKey cache_key_;
    std::filesystem::path cache_file_; // empty: none
    uint64_t cache_hash_ = 0;          // of what the file holds
    std::shared_ptr<MemoryLedger> ledger_ = std::make_shared<MemoryLedger>();
    DeviceTraits traits_;
    vk::PhysicalDeviceLimits limits_;
    vk::PhysicalDeviceMemoryProperties memory_;
};

// Opens a device that gives way to the server: a software device's own threads, which would take
// the processor from the thread that serves all viewers, run at this niceness, nice(2). Throws
// StartupError(kDevice).
[[nodiscard]] std::unique_ptr<Device> openForServing(const DeviceOptions& options,
                                                     int cpu_niceness);

} // namespace froxel::gpu
