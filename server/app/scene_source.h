// Where a scene comes from: the one entry point for `--scene PATH|builtin`.
#pragma once

#include "app/memory_limits.h"
#include "app/setting_options.h"
#include "bake/reader_process.h"
#include "core/error.h"
#include "core/progress.h"
#include "gltf/gltf_loader.h"
#include "guest/guest_scene.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace froxel::app {

// What of a scene is shown at first: a name in the file, else a number there from 1, or "none".
struct SceneChoices {
    std::string animation{};        // empty: the first, if there is one
    std::string material_variant{}; // empty: none
};

// By the numbers of bake::Sandbox.
inline constexpr std::array<std::string_view, 3> kSandboxNames = {"off", "best", "require"};

// Who reads a scene's file, and what that may take.
struct SceneReading {
    gltf::LoadLimits limits{.memory_bytes = readMemoryBytes()};
    bake::ReaderProcess process{};
};

[[nodiscard]] inline SceneReading readingBy(bake::Sandbox sandbox) {
    return {.process = {.sandbox = sandbox}};
}

// `builtin` gives the built-in hall, anything else is read as a scene file. Cameras that
// move stand where the animation begins. Errors with one line: kScene; kInvalidArgument where there
// is no such animation or variant; kCancelled where `report` has it end. `reading`: of
// a file.
[[nodiscard]] Result<scene::Scene> loadScene(const std::string& source,
                                             const SceneChoices& choices = {},
                                             const ProgressReport& report = workOn,
                                             const SceneReading& reading = {});

// The same of a scene that a client brought, by a process of its own in any case.
[[nodiscard]] Result<scene::Scene>
loadGuestScene(const std::shared_ptr<const guest::GuestScene>& brought,
               const ProgressReport& report,
               const SceneReading& reading);

// The settings of a view of it where nobody has asked for others: those given stay, the rest goes
// by the scene (scene::lookFor()) and `look`, if there is one. The built-in scene begins with the
// defaults. `software`: see scene::Look.
[[nodiscard]] settings::ViewSettings firstLook(const std::string& source,
                                               const scene::Scene& scene,
                                               const settings::ViewSettings& settings,
                                               const GivenSettings& given,
                                               const scene::Look* look,
                                               bool software);

// What a session and `froxel render` begin with: firstLook() with the look that was chosen, or else
// "evening" in the hall and where scene::suitsEvening(), or else fxaa where a device is not slow.
[[nodiscard]] settings::ViewSettings beginningOf(const std::string& source,
                                                 const scene::Scene& scene,
                                                 const settings::ViewSettings& settings,
                                                 const GivenSettings& given,
                                                 const ChosenLook& chosen,
                                                 bool software);

// Whether it is the built-in hall.
[[nodiscard]] bool isBuiltin(const std::string& source);

// A line of the log for each of the scene's warnings, which are few.
void logWarnings(const scene::Scene& scene);

} // namespace froxel::app
