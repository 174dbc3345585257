#include "app/camera_path_option.h"

#include "app/output_file.h"
#include "core/text.h"
#include "path/built_in_paths.h"
#include "path/path_file.h"

#include <algorithm>
#include <utility>

namespace froxel::app {

Result<path::CameraPath> readPathFile(const std::string& file) {
    const auto text = readText(file);
    if (!text) {
        return text.error();
    }
    auto keys = path::parsePath(*text);
    if (!keys) {
        return Error{keys.error().code, printable(file, 400) + ": " + keys.error().message};
    }
    return path::CameraPath(std::move(*keys));
}

Result<path::CameraPath> readCameraPath(const std::string& name,
                                        const scene::Scene& scene,
                                        const settings::Camera& first,
                                        double seconds) {
    const auto* const built_in = std::ranges::find(path::kBuiltInNames, name);
    if (built_in != path::kBuiltInNames.end()) {
        const auto which = static_cast<path::BuiltIn>(built_in - path::kBuiltInNames.begin());
        return path::CameraPath(path::builtInPath(which, scene, first, seconds));
    }
    return readPathFile(name);
}

} // namespace froxel::app
