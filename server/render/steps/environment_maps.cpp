#include "render/steps/environment_maps.h"

#include "core/assert.h"
#include "core/text.h"
#include "environment/albedo.h"
#include "gpu/upload.h"
#include "interface/environment_io.h"
#include "render/scene/scene_resources.h"

#include <utility>

namespace froxel::render {

namespace {

static_assert(io::kEnvironmentSize == environment::PrefilterSize{}.finest_px);
static_assert(io::kEnvironmentSize >> (io::kEnvironmentLevels - 1) ==
              environment::kCoarsestLevel_px);
static_assert(io::kLobeTableSize == environment::kAlbedoTableSize);
static_assert(io::kLobeLeastRoughness == static_cast<float>(environment::kLeastRoughness));

constexpr uint32_t kFaces = 6;

} // namespace

std::vector<glm::vec4> texelsOf(const environment::Prefiltered& glossy) {
    FROXEL_ASSERT(glossy.levels.size() == io::kEnvironmentLevels, "as many levels as shaders have");
    std::vector<glm::vec4> texels;
    texels.reserve(io::environmentTexel(io::kEnvironmentLevels));
    for (const auto& level : glossy.levels) {
        const int64_t size = level.size_px;
        for (uint32_t face = 0; face < kFaces; ++face) {
            for (int64_t y = -1; y <= size; ++y) {
                for (int64_t x = -1; x <= size; ++x) {
                    texels.emplace_back(glm::vec3(level.texel(face, x, y)), 0.0F);
                }
            }
        }
    }
    return texels;
}

EnvironmentMaps::EnvironmentMaps(SceneResources& scene)
    : scene_(scene), arena_(scene.shared.device),
      lobes_(upload(std::as_bytes(environment::albedoTable()), "environment lobes")),
      made_(scene.shared.timeline, scene.shared.variants, settings::kEnvironmentLightNames.size()) {
}

Result<const EnvironmentMaps::Map*> EnvironmentMaps::find(settings::EnvironmentLight light) {
    Map& map = maps_[light];
    if (*map.texels.handle) {
        return &map;
    }
    const auto seen = seenIn(light);
    if (!seen) {
        return seen.error();
    }
    const auto texels = texelsOf((*seen)->glossy);
    const auto bytes = std::as_bytes(std::span(texels));
    if (const uint64_t most = scene_.shared.device.limits().maxTexelBufferElements;
        texels.size() > most) {
        return Error{ErrorCode::kUnsupported,
                     "environment takes a buffer of " + numberText(texels.size()) +
                         " texels; this device's have at most " + numberText(most) + ": use off"};
    }
    if (map.seen == nullptr) { // else it was allowed, and there was none
        if (auto room = scene_.memory.take(bytes.size(), "light from around"); !room) {
            return room.error();
        }
        map.seen = *seen;
    }
    map.texels = upload(bytes, "environment levels");
    return &map;
}

Result<EnvironmentMaps::Seen> EnvironmentMaps::seenIn(settings::EnvironmentLight light) {
    if (light == settings::EnvironmentLight::kStudio) {
        return made_.findOrMake(light, [] { return &environment::studioSurroundings(); });
    }
    if (!scene_.surroundings) {
        return Error{ErrorCode::kUnsupported,
                     "environment is file, but no --environment-file was given; use studio or off"};
    }
    return scene_.surroundings.get();
}

gpu::Buffer EnvironmentMaps::upload(std::span<const std::byte> bytes, std::string_view name) {
    auto buffer = arena_.makeBuffer(bytes.size(),
                                    vk::BufferUsageFlagBits::eUniformTexelBuffer |
                                        vk::BufferUsageFlagBits::eTransferDst,
                                    gpu::MemoryUse::kDevice, name);
    gpu::uploadNow(scene_.shared.device, scene_.shared.timeline, buffer, bytes);
    return buffer;
}

} // namespace froxel::render
