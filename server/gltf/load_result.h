// What a load says where it gives no scene.
#pragma once

#include "core/error.h"
#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/load_progress.h"
#include "gltf/scene_folder.h"
#include "scene/scene.h"

#include <exception>
#include <filesystem>
#include <new>
#include <string>

namespace froxel::gltf {

// Whom a load's messages are about, at their begin.
[[nodiscard]] inline std::string begunWith(const std::filesystem::path& file) {
    return printable(file.filename().string(), 300) + ": ";
}

[[nodiscard]] inline Error sceneError(const std::filesystem::path& file,
                                      const std::string& message) {
    return {ErrorCode::kScene, begunWith(file) + message};
}

// What `load` gives, a Result or a scene, or why it cannot.
template <class Load>
[[nodiscard]] Result<scene::Scene> resultOf(const std::filesystem::path& file, Load load) {
    try {
        return load();
    } catch (const CalledOff&) {
        return Error{ErrorCode::kCancelled,
                     begunWith(file) + "cancelled, because nobody waits for it"};
    } catch (const Failure& failure) {
        return sceneError(file, failure.what());
    } catch (const std::bad_alloc&) {
        return sceneError(file, "out of memory; expected a smaller scene");
    } catch (const std::exception& error) {
        return sceneError(file, "cannot be read: " + printable(error.what(), 300));
    }
}

// What `load_from` gives of the scene's own folder, a Result, with the files that were looked for.
template <class LoadFrom>
[[nodiscard]] Result<scene::Scene>
loadOfFolder(const std::filesystem::path& file, bool no_link, LoadFrom load_from) {
    return resultOf(file, [&] {
        SceneFolder folder(file, no_link);
        Result<scene::Scene> scene = load_from(folder);
        if (scene) {
            scene->files = folder.takeFiles();
        }
        return scene;
    });
}

} // namespace froxel::gltf
