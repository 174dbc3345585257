// Where sessions ask for scenes, and whoever keeps them on the device, without knowing each other.
// Everything here may be called on any thread and never waits for a file or a device.
#pragma once

#include "core/error.h"
#include "core/progress.h"
#include "session/session_context.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace froxel::session {

// While anybody holds it, its scene stays on the device.
using SharedContext = std::shared_ptr<const SessionContext>;

enum class SceneStanding : uint8_t { kUnknown, kOffered, kLoading, kReady };

// What of a scene people choose by.
struct SceneContents {
    uint64_t file_bytes = 0; // of the scene's file and of all that this refers to
    uint64_t triangles = 0;  // drawn, instances counted each
    uint64_t materials = 0;
    uint64_t textures = 0;
    uint64_t lights = 0;
    uint64_t cameras = 0;
    uint64_t animations = 0;
    bool operator==(const SceneContents&) const = default;
};

[[nodiscard]] SceneContents contentsOf(const SceneSummary& scene);

struct SceneReport {
    SceneStanding standing = SceneStanding::kUnknown; // not offered
    Progress progress;                                // while it is loading
    std::optional<SceneContents> contents;            // once it was read, also after it left
};

// Of a server's scenes, for its operators.
struct SceneCounts {
    uint32_t resident = 0; // on the device, the first included
    uint32_t loading = 0;  // or waiting for it
    uint64_t bytes = 0;    // of the device's memory, but for the first
    uint64_t loaded_total = 0;
    uint64_t failed_total = 0;  // for their files
    uint64_t refused_total = 0; // for want of memory
    uint64_t evicted_total = 0;
};

// Who asked for a scene that was not there. Called without any lock of the port's.
class SceneWaiter {
  public:
    virtual ~SceneWaiter() = default;
    virtual void onSceneProgress(const std::string& id, const Progress& progress) = 0;
    // It is there, or why it is not; nothing more comes of it.
    virtual void onScene(const std::string& id, Result<SharedContext> scene) = 0;
    // Whether those who are not go first. Called under a lock of the port's.
    [[nodiscard]] virtual bool isPatient() const { return false; }
};

class ScenePort {
  public:
    virtual ~ScenePort() = default;
    // Null: it is being loaded, and the waiter hears of it. Errors: kInvalidArgument, where no such
    // scene is offered; kCapacity.
    [[nodiscard]] virtual Result<SharedContext>
    want(const std::string& id, const std::shared_ptr<SceneWaiter>& waiter) = 0;
    [[nodiscard]] virtual SceneCounts counts() const = 0;
    [[nodiscard]] virtual SceneReport reportOf(const std::string& id) const = 0;
    // The waiter, which may be about to end, does not want it any more; what nobody waits for is
    // not loaded.
    virtual void dismiss(const std::string& id, const std::weak_ptr<SceneWaiter>& waiter) = 0;
};

} // namespace froxel::session
