// What frames look up of light from around (lib/environment.glsl), on the device. Shared by all
// views and made when a frame first has it. Render thread.
#pragma once

#include "core/error.h"
#include "environment/surroundings.h"
#include "gpu/memory.h"
#include "render/pipelines/variant_cache.h"
#include "settings/settings.h"

#include <glm/vec4.hpp>

#include <map>
#include <span>
#include <string_view>
#include <vector>

namespace froxel::render {

class SceneResources;

// As io::environmentTexel() has them.
[[nodiscard]] std::vector<glm::vec4> texelsOf(const environment::Prefiltered& glossy);

class EnvironmentMaps {
  public:
    struct Map {
        const environment::Surroundings* seen = nullptr;
        gpu::Buffer texels;
    };

    explicit EnvironmentMaps(SceneResources& scene);

    // Of a light that is not off; stays where it is. Errors: kUnsupported where the scene has no
    // such light or the device no room for so many texels, kCapacity where the memory is not
    // allowed. Throws VariantsMissing while another thread filters it, vk::SystemError.
    [[nodiscard]] Result<const Map*> find(settings::EnvironmentLight light);
    // environment::albedoTable()
    [[nodiscard]] const gpu::Buffer& lobes() const { return lobes_; }

  private:
    using Seen = const environment::Surroundings*;

    [[nodiscard]] Result<Seen> seenIn(settings::EnvironmentLight light);
    [[nodiscard]] gpu::Buffer upload(std::span<const std::byte> bytes, std::string_view name);

    SceneResources& scene_;
    gpu::MemoryArena arena_;
    gpu::Buffer lobes_;
    VariantCache<settings::EnvironmentLight, Seen> made_;
    std::map<settings::EnvironmentLight, Map> maps_;
};

} // namespace froxel::render
