// The device as reports name it; apart from gpu/device.h so that reports need not see Vulkan.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace froxel::gpu {
struct DeviceTraits;
}

namespace froxel::report {

struct DeviceSummary {
    std::string name;
    std::string driver;
    std::string kind;   // "cpu" or "gpu"
    std::string vulkan; // such as "1.3.250"
    uint32_t subgroup_size = 0;
};

[[nodiscard]] DeviceSummary summarize(const gpu::DeviceTraits& traits);
[[nodiscard]] nlohmann::ordered_json toJson(const DeviceSummary& device);

} // namespace froxel::report
