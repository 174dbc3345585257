#include "app/light_set_file.h"

#include "app/output_file.h"
#include "session/placed_lights.h"

#include <spdlog/fmt/fmt.h>

#include <system_error>

namespace froxel::app {

Result<settings::PlacedLights> readLightSet(const std::filesystem::path& path) {
    // Some thirty times what the most lights take: nobody's video by mistake.
    constexpr uintmax_t kMaxBytes = 16 * 1024 * 1024;
    std::error_code failure;
    if (const auto size = std::filesystem::file_size(path, failure); !failure && size > kMaxBytes) {
        return Error{ErrorCode::kInvalidArgument,
                     fmt::format("light set '{}' has {} bytes; at most {} are read", path.string(),
                                 size, kMaxBytes)};
    }
    const auto text = readText(path);
    if (!text) {
        return text.error();
    }
    const auto lights = session::parseLightSet(*text);
    if (!lights) {
        return Error{ErrorCode::kInvalidArgument,
                     fmt::format("light set '{}': {}", path.string(), lights.error().message)};
    }
    return *lights;
}

} // namespace froxel::app
