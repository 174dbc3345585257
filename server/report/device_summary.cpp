#include "report/device_summary.h"

#include "gpu/device.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace froxel::report {

DeviceSummary summarize(const gpu::DeviceTraits& traits) {
    const uint32_t version = traits.api_version;
    return {.name = traits.name,
            .driver = traits.driver,
            .kind = traits.is_cpu ? "cpu" : "gpu",
            .vulkan = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version),
                                  VK_API_VERSION_MINOR(version), VK_API_VERSION_PATCH(version)),
            .subgroup_size = traits.subgroup_size};
}

nlohmann::ordered_json toJson(const DeviceSummary& device) {
    return {{"name", device.name},
            {"driver", device.driver},
            {"kind", device.kind},
            {"vulkan", device.vulkan},
            {"subgroup_size", device.subgroup_size}};
}

} // namespace froxel::report
