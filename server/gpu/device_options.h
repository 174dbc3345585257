// Which device to open; apart from device.h so that options need not see Vulkan's headers.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace froxel::gpu {

// kAuto: a GPU if there is one, else a CPU device.
enum class DeviceChoice : uint8_t { kAuto, kGpu, kCpu };
inline constexpr std::array kDeviceChoiceNames = {std::string_view("auto"), std::string_view("gpu"),
                                                  std::string_view("cpu")};

// Where compiled pipelines are kept from run to run.
struct PipelineCacheOptions {
    std::filesystem::path folder; // empty: nowhere
    uint64_t build = 0;           // hash of the build's shaders
};

// Where what the host reads is copied beside what is drawn.
enum class CopyQueue : uint8_t {
    kOwn,  // a queue for copies alone, where the device has one; else kNone
    kNone, // nowhere: in the frame's own commands
    kSame, // for tests: the one queue, as if it were another
};

struct DeviceOptions {
    DeviceChoice choice = DeviceChoice::kAuto;
    PipelineCacheOptions pipeline_cache;
    bool validation = false; // with the Khronos validation layer
    bool subgroups = true;   // false: as on a device without subgroup operations
    // false: as on a device without what they need.
    bool descriptor_indexing = true;
    bool visibility = true; // visibility passes
    bool int64_atomics = true;
    CopyQueue copy_queue = CopyQueue::kOwn;
    uint32_t most_textures = ~0U; // a shader reads; less: as on a device that allows less
};

} // namespace froxel::gpu
