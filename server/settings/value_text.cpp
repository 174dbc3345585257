#include "settings/value_text.h"

#include "core/text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

namespace froxel::settings {

namespace {

Error invalid(std::string_view text, std::string_view wanted) {
    return {ErrorCode::kInvalidArgument, fmt::format("'{}' is not {}", printable(text), wanted)};
}

// The whole text as a number, or nothing.
template <class T>
std::optional<T> readNumber(std::string_view text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [stop, status] = std::from_chars(text.data(), end, value);
    if (status != std::errc{} || stop != end) {
        return std::nullopt;
    }
    return value;
}

template <class T>
std::optional<T> readInRange(std::string_view text, const Range<T>& range) {
    const auto value = readNumber<T>(text);
    return value && range.contains(*value) ? value : std::nullopt;
}

template <class T>
Result<T> parseInRange(std::string_view text, const Range<T>& range) {
    const auto value = readInRange(text, range);
    if (!value) {
        return invalid(text, describe(range));
    }
    return *value;
}

std::optional<glm::dvec3> readPosition(std::string_view text) {
    const auto parts = split(text, ',');
    if (parts.size() != 3) {
        return std::nullopt;
    }
    glm::dvec3 position{0};
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = readInRange(parts[static_cast<size_t>(axis)], kPositionRange);
        if (!value) {
            return std::nullopt;
        }
        position[axis] = *value;
    }
    return position;
}

} // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (size_t at = 0; at != std::string_view::npos;) {
        const size_t end = std::min(text.find(separator, at), text.size());
        parts.push_back(text.substr(at, end - at));
        at = end < text.size() ? end + 1 : std::string_view::npos;
    }
    return parts;
}

std::string describe(const Range<uint32_t>& range) {
    return fmt::format("a whole number from {} to {}", range.min, range.max);
}

std::string describe(const Range<double>& range) {
    return fmt::format("a number from {} to {}", range.min, range.max);
}

std::string describe(std::span<const std::string_view> names) {
    return fmt::format("{} or {}", fmt::join(names.first(names.size() - 1), ", "), names.back());
}

Result<uint32_t> parseNumber(std::string_view text, const Range<uint32_t>& range) {
    return parseInRange(text, range);
}

Result<double> parseNumber(std::string_view text, const Range<double>& range) {
    return parseInRange(text, range);
}

Result<bool> parseSwitch(std::string_view text) {
    return text == "0" || text == "1" ? Result<bool>(text == "1") : invalid(text, "0 or 1");
}

Result<size_t> parseName(std::string_view text, std::span<const std::string_view> names) {
    const auto found = std::ranges::find(names, text);
    if (found == names.end()) {
        return invalid(text, describe(names));
    }
    return static_cast<size_t>(found - names.begin());
}

Result<Size> parseSize(std::string_view text) {
    const auto parts = split(text, 'x');
    if (parts.size() == 2) {
        const auto width = readInRange(parts[0], kWidthRange);
        const auto height = readInRange(parts[1], kHeightRange);
        if (width && height) {
            return Size{*width, *height};
        }
    }
    return invalid(text, fmt::format("WIDTHxHEIGHT in pixels from {}x{} to {}x{}, such as 1280x720",
                                     kWidthRange.min, kHeightRange.min, kWidthRange.max,
                                     kHeightRange.max));
}

Result<GridSize> parseGrid(std::string_view text) {
    const auto parts = split(text, 'x');
    if (parts.size() == 3) {
        const auto x = readInRange(parts[0], kGridXRange);
        const auto y = readInRange(parts[1], kGridYRange);
        const auto z = readInRange(parts[2], kGridZRange);
        if (x && y && z) {
            return GridSize{*x, *y, *z};
        }
    }
    return invalid(text,
                   fmt::format("auto or XxYxZ clusters from {}x{}x{} to {}x{}x{}, such as 16x9x24",
                               kGridXRange.min, kGridYRange.min, kGridZRange.min, kGridXRange.max,
                               kGridYRange.max, kGridZRange.max));
}

Result<Grid> parseGridChoice(std::string_view text, const Grid& before) {
    Grid grid = before;
    grid.automatic = text == "auto";
    if (!grid.automatic) {
        const auto size = parseGrid(text);
        if (!size) {
            return size.error();
        }
        grid.size = *size;
    }
    return grid;
}

Result<glm::dvec2> parseLensShift(std::string_view text) {
    const auto parts = split(text, ',');
    if (parts.size() == 2) {
        const auto x = readInRange(parts[0], kLensShiftXRange);
        const auto y = readInRange(parts[1], kLensShiftYRange);
        if (x && y) {
            return glm::dvec2(*x, *y);
        }
    }
    return invalid(text, fmt::format("\"x,y\" in half pictures, each from {} to {}, such as "
                                     "\"0,0.5\"",
                                     kLensShiftXRange.min, kLensShiftXRange.max));
}

Result<glm::dvec3> parseColor(std::string_view text, const Range<double>& range) {
    const auto parts = split(text, ',');
    if (parts.size() == 3) {
        const auto red = readInRange(parts[0], range);
        const auto green = readInRange(parts[1], range);
        const auto blue = readInRange(parts[2], range);
        if (red && green && blue) {
            return glm::dvec3(*red, *green, *blue);
        }
    }
    return invalid(text, fmt::format("\"red,green,blue\", each from {} to {}, such as "
                                     "\"0.9,0.9,1\"",
                                     range.min, range.max));
}

Result<glm::dvec3> parsePosition(std::string_view text) {
    const auto position = readPosition(text);
    return position ? Result<glm::dvec3>(*position)
                    : invalid(text, fmt::format("\"x,y,z\" in metres, each from {} to {}, such as "
                                                "\"-7,2,0\"",
                                                kPositionRange.min, kPositionRange.max));
}

Result<BoundsD3> parseBox(std::string_view text) {
    const auto corners = split(text, ';');
    if (corners.size() == 2) {
        const auto least = readPosition(corners[0]);
        const auto greatest = readPosition(corners[1]);
        if (least && greatest && glm::all(glm::lessThan(*least, *greatest))) {
            return BoundsD3{*least, *greatest};
        }
    }
    return invalid(text, fmt::format("\"x,y,z;x,y,z\" in metres, the smallest corner first, each "
                                     "number from {} to {}, such as \"-10,0,-5;10,8,5\"",
                                     kPositionRange.min, kPositionRange.max));
}

Result<ToonRamp> parseRamp(std::string_view text) {
    ToonRamp ramp;
    ramp.count = 0;
    ramp.points = {};
    const auto points = split(text, ';');
    bool right = points.size() >= 2 && points.size() <= ToonRamp::kMaxPoints;
    for (size_t i = 0; right && i < points.size(); ++i) {
        const auto numbers = split(points[i], ',');
        right = numbers.size() == 3;
        const auto x = right ? readInRange(numbers[0], kToonRange) : std::nullopt;
        const auto y = right ? readInRange(numbers[1], kToonRange) : std::nullopt;
        const auto slope = right ? readInRange(numbers[2], kToonSlopeRange) : std::nullopt;
        right = x && y && slope;
        if (right) {
            auto& point = ramp.points[ramp.count++];
            point = {static_cast<float>(*x), static_cast<float>(*y), static_cast<float>(*slope)};
            // In float, as the shader will see them: equal neighbours would divide by zero.
            right = i == 0 || point.x > ramp.points[i - 1].x;
        }
    }
    return right ? Result<ToonRamp>(ramp)
                 : invalid(text, fmt::format("\"x,y,slope;...\", 2 to {} points in ascending x, "
                                             "such as \"0,0,1;1,1,1\"",
                                             ToonRamp::kMaxPoints));
}

Result<SettingValue> parseSetting(const Setting& setting, std::string_view text) {
    const auto value = [](const auto& parsed) -> Result<SettingValue> {
        return parsed ? Result<SettingValue>(*parsed) : parsed.error();
    };
    const Range<double> range{setting.name, setting.min, setting.max};
    switch (setting.kind) {
    case SettingKind::kSwitch:
        return value(parseSwitch(text));
    case SettingKind::kChoice: {
        const auto index = parseName(text, setting.names);
        return index ? Result<SettingValue>(Choice{*index}) : index.error();
    }
    case SettingKind::kWhole:
        return value(
            parseNumber(text, Range<uint32_t>{setting.name, static_cast<uint32_t>(setting.min),
                                              static_cast<uint32_t>(setting.max)}));
    case SettingKind::kColor:
        return value(parseColor(text, range));
    case SettingKind::kReal:
        break;
    }
    return value(parseNumber(text, range));
}

} // namespace froxel::settings
