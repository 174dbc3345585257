#include "app/environment_file.h"

#include "app/output_file.h"
#include "core/text.h"
#include "environment/panorama.h"
#include "environment/surroundings.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

namespace froxel::app {

Result<environment::Panorama> readPanorama(const std::filesystem::path& file) {
    // Twice what four channels of floats take.
    constexpr uintmax_t kMaxBytes =
        uintmax_t{16} * environment::kMaxPanoramaWidth_px * environment::kMaxPanoramaWidth_px;
    const std::string user = fmt::format("environment file '{}'", file.string());
    std::error_code failure;
    if (const auto size = std::filesystem::file_size(file, failure); !failure && size > kMaxBytes) {
        return Error{ErrorCode::kCapacity,
                     fmt::format("{} has {} bytes; at most {} are read", user, size, kMaxBytes)};
    }
    const auto bytes = readText(file);
    if (!bytes) {
        return bytes.error();
    }
    return environment::read(std::as_bytes(std::span(*bytes)), user);
}

std::shared_ptr<const environment::Surroundings>
readSurroundings(const std::filesystem::path& file) {
    if (file.empty()) {
        return nullptr;
    }
    auto panorama = readPanorama(file).value();
    for (const std::string& warning : panorama.warnings) {
        spdlog::warn("event=environment_warning text={}", logValue(warning, 400));
    }
    return std::make_shared<const environment::Surroundings>(
        environment::surroundingsOf(std::move(panorama.image)));
}

void surround(scene::Scene& scene, std::shared_ptr<const environment::Surroundings> surroundings) {
    if (surroundings) {
        scene.surroundings = std::move(surroundings);
    }
}

nlohmann::ordered_json environmentReport(const environment::Panorama& panorama) {
    const LinearImage& image = panorama.image;
    const glm::dvec3 mean = environment::meanRadiance(image);
    return {{"size_px", {image.width_px, image.height_px}},
            {"mean_radiance", {mean.x, mean.y, mean.z}},
            {"most_radiance", *std::max_element(image.rgb.begin(), image.rgb.end())},
            {"warnings", panorama.warnings}};
}

} // namespace froxel::app
