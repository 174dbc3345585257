#include "app/value_parsers.h"

#include "core/text.h"

#include <spdlog/fmt/fmt.h>

namespace froxel::app {

Result<CameraChoice> parseCamera(std::string_view text) {
    const auto parts = settings::split(text, ';');
    if (parts.size() == 1 && !text.empty()) {
        return CameraChoice(std::string(text));
    }
    if (parts.size() == 3) {
        const auto eye = settings::parsePosition(parts[0]);
        const auto target = settings::parsePosition(parts[1]);
        const auto fov_deg = parseNumber(parts[2], settings::kFovRange);
        if (eye && target && fov_deg && *eye != *target) {
            auto camera = settings::lookAt(*eye, *target, {0, 1, 0});
            camera.yfov_rad = glm::radians(*fov_deg);
            return CameraChoice(camera);
        }
    }
    return Error{
        ErrorCode::kInvalidArgument,
        fmt::format("'{}' is neither a scene camera's name nor \"ex,ey,ez;tx,ty,tz;fov\". Eye and "
                    "target are in metres ({} to {}), and fov is the vertical angle in degrees "
                    "({} to {}). For example: \"-7,2,0;0,2,0;45\"",
                    printable(text), settings::kPositionRange.min, settings::kPositionRange.max,
                    settings::kFovRange.min, settings::kFovRange.max)};
}

} // namespace froxel::app
