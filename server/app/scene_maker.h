// A scene's file into what a server shows of it, for the scene that it begins with and for all that
// it is asked for later.
#pragma once

#include "app/serve_command.h"
#include "core/progress.h"
#include "gltf/gltf_loader.h"
#include "gpu/device.h"
#include "guest/guest_scene.h"
#include "stream/scene_host.h"

#include <memory>
#include <string>

namespace froxel::app {

class SceneMaker {
  public:
    // Takes some seconds where there is an environment's file. Throws StartupError where it is
    // none.
    SceneMaker(const ServeOptions& options, const gpu::DeviceTraits& device);

    // As loadScene(). Any thread; takes long.
    [[nodiscard]] Result<stream::ReadScene> make(const std::string& source,
                                                 const SceneChoices& choices,
                                                 const ProgressReport& report,
                                                 const gltf::LoadLimits& limits) const;

    // As loadGuestScene(), likewise.
    [[nodiscard]] Result<stream::ReadScene>
    makeGuest(const std::shared_ptr<const guest::GuestScene>& brought,
              const ProgressReport& report,
              uint64_t memory_bytes) const;

  private:
    [[nodiscard]] Result<stream::ReadScene> finish(const std::string& source,
                                                   Result<scene::Scene> loaded) const;
    [[nodiscard]] session::SessionDefaults defaultsOf(const std::string& source,
                                                      const scene::Scene& scene) const;
    [[nodiscard]] std::vector<session::OfferedLook> looksOf(const std::string& source,
                                                            const scene::Scene& scene) const;

    const ServeOptions options_;
    const bool device_is_cpu_;
    const std::string device_name_;
    // Of all scenes; null: each has its own, or none.
    const std::shared_ptr<const environment::Surroundings> surroundings_;
};

} // namespace froxel::app
