#include "app/value_parsers.h"

#include "core/text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

namespace froxel::app {

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
std::optional<T> readInRange(std::string_view text, const settings::Range<T>& range) {
    const auto value = readNumber<T>(text);
    return value && range.contains(*value) ? value : std::nullopt;
}

template <class T>
Result<T> parseInRange(std::string_view text, const settings::Range<T>& range) {
    const auto value = readInRange(text, range);
    if (!value) {
        return invalid(text, describe(range));
    }
    return *value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (size_t at = 0; at != std::string_view::npos;) {
        const size_t end = std::min(text.find(separator, at), text.size());
        parts.push_back(text.substr(at, end - at));
        at = end < text.size() ? end + 1 : std::string_view::npos;
    }
    return parts;
}

std::optional<glm::dvec3> readPosition(std::string_view text) {
    const auto parts = split(text, ',');
    if (parts.size() != 3) {
        return std::nullopt;
    }
    glm::dvec3 position{0};
    for (int axis = 0; axis < 3; ++axis) {
        const auto value = readInRange(parts[static_cast<size_t>(axis)], settings::kPositionRange);
        if (!value) {
            return std::nullopt;
        }
        position[axis] = *value;
    }
    return position;
}

} // namespace

std::string describe(const settings::Range<uint32_t>& range) {
    return fmt::format("a whole number from {} to {}", range.min, range.max);
}

std::string describe(const settings::Range<double>& range) {
    return fmt::format("a number from {} to {}", range.min, range.max);
}

std::string describe(std::span<const std::string_view> names) {
    return fmt::format("{} or {}", fmt::join(names.first(names.size() - 1), ", "), names.back());
}

Result<uint32_t> parseNumber(std::string_view text, const settings::Range<uint32_t>& range) {
    return parseInRange(text, range);
}

Result<double> parseNumber(std::string_view text, const settings::Range<double>& range) {
    return parseInRange(text, range);
}

Result<size_t> parseName(std::string_view text, std::span<const std::string_view> names) {
    const auto found = std::ranges::find(names, text);
    if (found == names.end()) {
        return invalid(text, describe(names));
    }
    return static_cast<size_t>(found - names.begin());
}

Result<settings::Size> parseSize(std::string_view text) {
    const auto parts = split(text, 'x');
    if (parts.size() == 2) {
        const auto width = readInRange(parts[0], settings::kWidthRange);
        const auto height = readInRange(parts[1], settings::kHeightRange);
        if (width && height) {
            return settings::Size{*width, *height};
        }
    }
    return invalid(text, fmt::format("WIDTHxHEIGHT in pixels from {}x{} to {}x{}, such as 1280x720",
                                     settings::kWidthRange.min, settings::kHeightRange.min,
                                     settings::kWidthRange.max, settings::kHeightRange.max));
}

Result<settings::GridSize> parseGrid(std::string_view text) {
    const auto parts = split(text, 'x');
    if (parts.size() == 3) {
        const auto x = readInRange(parts[0], settings::kGridXRange);
        const auto y = readInRange(parts[1], settings::kGridYRange);
        const auto z = readInRange(parts[2], settings::kGridZRange);
        if (x && y && z) {
            return settings::GridSize{*x, *y, *z};
        }
    }
    return invalid(text,
                   fmt::format("auto or XxYxZ clusters from {}x{}x{} to {}x{}x{}, such as 16x9x24",
                               settings::kGridXRange.min, settings::kGridYRange.min,
                               settings::kGridZRange.min, settings::kGridXRange.max,
                               settings::kGridYRange.max, settings::kGridZRange.max));
}

Result<settings::Grid> parseGridChoice(std::string_view text, const settings::Grid& before) {
    settings::Grid grid = before;
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
        const auto x = readInRange(parts[0], settings::kLensShiftXRange);
        const auto y = readInRange(parts[1], settings::kLensShiftYRange);
        if (x && y) {
            return glm::dvec2(*x, *y);
        }
    }
    return invalid(text,
                   fmt::format("\"x,y\" in half pictures, each from {} to {}, such as "
                               "\"0,0.5\"",
                               settings::kLensShiftXRange.min, settings::kLensShiftXRange.max));
}

Result<glm::dvec3> parseColor(std::string_view text, const settings::Range<double>& range) {
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

Result<BoundsD3> parseBox(std::string_view text) {
    const auto corners = split(text, ';');
    if (corners.size() == 2) {
        const auto least = readPosition(corners[0]);
        const auto greatest = readPosition(corners[1]);
        if (least && greatest && glm::all(glm::lessThan(*least, *greatest))) {
            return BoundsD3{*least, *greatest};
        }
    }
    return invalid(text,
                   fmt::format("\"x,y,z;x,y,z\" in metres, the least corner first, each number "
                               "from {} to {}, such as \"-10,0,-5;10,8,5\"",
                               settings::kPositionRange.min, settings::kPositionRange.max));
}

Result<CameraChoice> parseCamera(std::string_view text) {
    const auto parts = split(text, ';');
    if (parts.size() == 1 && !text.empty()) {
        return CameraChoice(std::string(text));
    }
    if (parts.size() == 3) {
        const auto eye = readPosition(parts[0]);
        const auto target = readPosition(parts[1]);
        const auto fov_deg = readInRange(parts[2], settings::kFovRange);
        if (eye && target && fov_deg && *eye != *target) {
            auto camera = settings::lookAt(*eye, *target, {0, 1, 0});
            camera.yfov_rad = glm::radians(*fov_deg);
            return CameraChoice(camera);
        }
    }
    return invalid(
        text, fmt::format("a scene camera's name or \"ex,ey,ez;tx,ty,tz;fov\": eye and another "
                          "point that it looks at in metres ({} to {}), vertical field of view "
                          "in degrees ({} to {}), such as \"-7,2,0;0,2,0;45\"",
                          settings::kPositionRange.min, settings::kPositionRange.max,
                          settings::kFovRange.min, settings::kFovRange.max));
}

} // namespace froxel::app
