#include "gltf/gltf_loader.h"

#include "core/text.h"
#include "gltf/document.h"
#include "gltf/failure.h"
#include "gltf/load_progress.h"
#include "gltf/scene_builder.h"
#include "gltf/scene_folder.h"

#include <exception>
#include <new>
#include <string>

namespace froxel::gltf {
namespace {

Error sceneError(const std::filesystem::path& file, const std::string& message) {
    return {ErrorCode::kScene, printable(file.filename().string(), 300) + ": " + message};
}

} // namespace

Result<scene::Scene>
load(const std::filesystem::path& file, const ProgressReport& report, const LoadLimits& limits) {
    try {
        Warnings warnings;
        LoadProgress progress(report);
        ReadMemory memory(limits.memory_bytes);
        progress.reading(0);
        SceneFolder folder(file, limits.no_link, progress, memory);
        const Document document = readDocument(folder, memory, warnings);
        scene::Scene scene = buildScene(document, folder, progress, memory, warnings);
        scene.name = file.stem().string();
        scene.file_bytes = folder.fileBytes();
        scene.files = folder.takeFiles();
        warnings.moveInto(scene);
        return scene;
    } catch (const CalledOff&) {
        return Error{ErrorCode::kCancelled, printable(file.filename().string(), 300) +
                                                ": cancelled, because nobody waits for it"};
    } catch (const Failure& failure) {
        return sceneError(file, failure.what());
    } catch (const std::bad_alloc&) {
        return sceneError(file, "out of memory; expected a smaller scene");
    } catch (const std::exception& error) {
        return sceneError(file, "cannot be read: " + printable(error.what(), 300));
    }
}

} // namespace froxel::gltf
