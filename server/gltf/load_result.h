// What a load says where it gives no scene.
#pragma once

#include "core/error.h"
#include "core/text.h"
#include "gltf/failure.h"
#include "gltf/load_progress.h"
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

} // namespace froxel::gltf
