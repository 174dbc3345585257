// Who makes viewers' JPEGs.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace froxel::stream {

enum class JpegPlace : uint8_t {
    kAuto,   // the device, where it is a GPU and faster than all encoders together
    kDevice, // the device, where its files are right
    kHost,
};
inline constexpr std::array<std::string_view, 3> kJpegPlaceNames = {"auto", "device", "host"};

} // namespace froxel::stream
