#include "formats/scene_loader.h"

#include "formats/glb_opener.h"
#include "gltf/load_result.h"
#include "gltf/warnings.h"

namespace froxel::formats {

Result<scene::Scene> loadFrom(gltf::FileOpener& opener,
                              const std::filesystem::path& file,
                              const ProgressReport& report,
                              uint64_t memory_bytes) {
    if (!GlbOpener::isConverted(file)) {
        return gltf::loadFrom(opener, file, report, memory_bytes);
    }
    gltf::Warnings warnings;
    GlbOpener converted(opener, file, memory_bytes, warnings);
    auto scene = gltf::loadFrom(converted, file, report, memory_bytes);
    if (scene) {
        warnings.moveInto(*scene);
    }
    return scene;
}

Result<scene::Scene> load(const std::filesystem::path& file,
                          const ProgressReport& report,
                          const gltf::LoadLimits& limits) {
    return gltf::loadOfFolder(file, limits.no_link, [&](gltf::FileOpener& folder) {
        return formats::loadFrom(folder, file, report, limits.memory_bytes);
    });
}

} // namespace froxel::formats
