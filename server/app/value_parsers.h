// Texts of the command line to values: pure and strict (no NaN, nothing after the value, ranges
// from settings/ranges.h). Errors are kInvalidArgument; the message quotes the text and says what
// would be right, and the caller puts the option's name before it.
#pragma once

#include "core/error.h"
#include "settings/ranges.h"
#include "settings/settings.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace froxel::app {

// The scene's first camera (the whole scene in view when it has none), a scene's camera by its
// name, or one given by numbers.
struct DefaultCamera {
    bool operator==(const DefaultCamera&) const = default;
};
using CameraChoice = std::variant<DefaultCamera, std::string, settings::Camera>;

// TCP ports; 0 stands for any free one.
inline constexpr settings::Range<uint32_t> kPortRange{"port", 0, 65535};

// "a whole number from 0 to 1000000": for messages and help.
[[nodiscard]] std::string describe(const settings::Range<uint32_t>& range);
[[nodiscard]] std::string describe(const settings::Range<double>& range);
// "naive, forward_plus or toon_compute": for messages and help.
[[nodiscard]] std::string describe(std::span<const std::string_view> names);

[[nodiscard]] Result<uint32_t> parseNumber(std::string_view text,
                                           const settings::Range<uint32_t>& range);
[[nodiscard]] Result<double> parseNumber(std::string_view text,
                                         const settings::Range<double>& range);

// The position of `text` in `names`.
[[nodiscard]] Result<size_t> parseName(std::string_view text,
                                       std::span<const std::string_view> names);

// "1280x720", in pixels.
[[nodiscard]] Result<settings::Size> parseSize(std::string_view text);

// "16x9x24": tiles across, tiles down, depth slices.
[[nodiscard]] Result<settings::GridSize> parseGrid(std::string_view text);

// "auto", or a size as above, which is not automatic; the law stays as in `before`.
[[nodiscard]] Result<settings::Grid> parseGridChoice(std::string_view text,
                                                     const settings::Grid& before);

// "0.5,-1": right and up, in half pictures.
[[nodiscard]] Result<glm::dvec2> parseLensShift(std::string_view text);

// "0.9,0.9,1": red, green and blue, each in the range.
[[nodiscard]] Result<glm::dvec3> parseColor(std::string_view text,
                                            const settings::Range<double>& range);

// "x,y,z;x,y,z" in metres: the least corner, then the greatest, apart on every axis.
[[nodiscard]] Result<BoundsD3> parseBox(std::string_view text);

// "ex,ey,ez;tx,ty,tz;fov": eye and target in metres, full vertical angle in degrees, upright (+Y).
// A text without a semicolon is a scene camera's name; whether it exists is not known here.
[[nodiscard]] Result<CameraChoice> parseCamera(std::string_view text);

} // namespace froxel::app
