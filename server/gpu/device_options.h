// Which device to open; apart from device.h so that options need not see Vulkan's headers.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace froxel::gpu {

// kAuto: a GPU if there is one, else a CPU device.
enum class DeviceChoice : uint8_t { kAuto, kGpu, kCpu };
inline constexpr std::array kDeviceChoiceNames = {std::string_view("auto"), std::string_view("gpu"),
                                                  std::string_view("cpu")};

struct DeviceOptions {
    DeviceChoice choice = DeviceChoice::kAuto;
    bool validation = false; // with the Khronos validation layer
    bool subgroups = true;   // false: as on a device without subgroup operations
};

} // namespace froxel::gpu
