#include "gltf/gltf_loader.h"

#include "gltf/document.h"
#include "gltf/load_progress.h"
#include "gltf/load_result.h"
#include "gltf/scene_builder.h"
#include "gltf/scene_files.h"

namespace froxel::gltf {
namespace {

scene::Scene read(FileOpener& opener,
                  const std::filesystem::path& file,
                  const ProgressReport& report,
                  uint64_t memory_bytes) {
    Warnings warnings;
    LoadProgress progress(report);
    ReadMemory memory(memory_bytes);
    progress.reading(0);
    SceneFiles files(opener, progress, memory);
    const Document document = readDocument(files, memory, warnings);
    scene::Scene scene = buildScene(document, files, progress, memory, warnings);
    scene.name = file.stem().string();
    scene.extensions = document.extensions;
    scene.file_bytes = files.fileBytes();
    warnings.moveInto(scene);
    return scene;
}

} // namespace

Result<scene::Scene>
load(const std::filesystem::path& file, const ProgressReport& report, const LoadLimits& limits) {
    return loadOfFolder(file, limits.no_link, [&](FileOpener& folder) {
        return loadFrom(folder, file, report, limits.memory_bytes);
    });
}

Result<scene::Scene> loadFrom(FileOpener& opener,
                              const std::filesystem::path& file,
                              const ProgressReport& report,
                              uint64_t memory_bytes) {
    return resultOf(file, [&] { return read(opener, file, report, memory_bytes); });
}

} // namespace froxel::gltf
