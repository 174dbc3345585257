// Texts of the command line alone to values; those of settings are in settings/value_text.h, whose
// rules and errors they share.
#pragma once

#include "settings/value_text.h"

#include <string>
#include <string_view>
#include <variant>

namespace froxel::app {

using settings::describe;
using settings::parseBox;
using settings::parseColor;
using settings::parseGrid;
using settings::parseGridChoice;
using settings::parseLensShift;
using settings::parseName;
using settings::parseNumber;
using settings::parseSetting;
using settings::parseSize;

// The scene's first camera (the whole scene in view when it has none), a scene's camera by its
// name, or one given by numbers.
struct DefaultCamera {
    bool operator==(const DefaultCamera&) const = default;
};
using CameraChoice = std::variant<DefaultCamera, std::string, settings::Camera>;

// TCP ports; 0 stands for any free one.
inline constexpr settings::Range<uint32_t> kPortRange{"port", 0, 65535};

// "ex,ey,ez;tx,ty,tz;fov": eye and target in metres, full vertical angle in degrees, upright (+Y).
// A text without a semicolon is a scene camera's name; whether it exists is not known here.
[[nodiscard]] Result<CameraChoice> parseCamera(std::string_view text);

} // namespace froxel::app
