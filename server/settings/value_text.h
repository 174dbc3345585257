// Texts of options and addresses to values: pure and strict (no NaN, nothing after the value,
// ranges from settings/ranges.h). Errors are kInvalidArgument; the message quotes the text and says
// what would be right, and the caller puts the name before it.
#pragma once

#include "core/error.h"
#include "settings/ranges.h"
#include "settings/setting.h"
#include "settings/settings.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::settings {

// "a whole number from 0 to 1000000": for messages and help.
[[nodiscard]] std::string describe(const Range<uint32_t>& range);
[[nodiscard]] std::string describe(const Range<double>& range);
// "naive, forward_plus or toon_compute": for messages and help.
[[nodiscard]] std::string describe(std::span<const std::string_view> names);

[[nodiscard]] Result<uint32_t> parseNumber(std::string_view text, const Range<uint32_t>& range);
[[nodiscard]] Result<double> parseNumber(std::string_view text, const Range<double>& range);

// "0" or "1".
[[nodiscard]] Result<bool> parseSwitch(std::string_view text);

// The position of `text` in `names`.
[[nodiscard]] Result<size_t> parseName(std::string_view text,
                                       std::span<const std::string_view> names);

// "1280x720", in pixels.
[[nodiscard]] Result<Size> parseSize(std::string_view text);

// "16x9x24": tiles across, tiles down, depth slices.
[[nodiscard]] Result<GridSize> parseGrid(std::string_view text);

// "auto", or a size as above, which is not automatic; the law stays as in `before`.
[[nodiscard]] Result<Grid> parseGridChoice(std::string_view text, const Grid& before);

// "0.5,-1": right and up, in half pictures.
[[nodiscard]] Result<glm::dvec2> parseLensShift(std::string_view text);

// "0.9,0.9,1": red, green and blue, each in the range.
[[nodiscard]] Result<glm::dvec3> parseColor(std::string_view text, const Range<double>& range);

// "x,y,z" in metres.
[[nodiscard]] Result<glm::dvec3> parsePosition(std::string_view text);

// "x,y,z;x,y,z" in metres: the least corner, then the greatest, apart on every axis.
[[nodiscard]] Result<BoundsD3> parseBox(std::string_view text);

// "x,y,slope;...": 2 to ToonRamp::kMaxPoints points, apart in ascending x.
[[nodiscard]] Result<ToonRamp> parseRamp(std::string_view text);

// What a setting is set to: "0.5", "mip_chain", "1,1,0.5"; a switch by "0" or "1".
[[nodiscard]] Result<SettingValue> parseSetting(const Setting& setting, std::string_view text);

// "a;b;c" into its parts, at least one.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

} // namespace froxel::settings
