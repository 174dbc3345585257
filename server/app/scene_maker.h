// A scene's file into what a server shows of it, for the scene that it begins with and for all that
// it is asked for later.
#pragma once

#include "app/serve_command.h"
#include "gpu/device.h"
#include "stream/scene_host.h"

#include <string>

namespace froxel::app {

class SceneMaker {
  public:
    SceneMaker(const ServeOptions& options, const gpu::DeviceTraits& device)
        : options_(options), device_is_cpu_(device.is_cpu), device_name_(device.name) {}

    // `source` as for loadScene(). Any thread; takes long. Errors: loadScene()'s. Throws
    // StartupError where the environment's file is none.
    [[nodiscard]] Result<stream::ReadScene> make(const std::string& source,
                                                 const SceneChoices& choices) const;

  private:
    [[nodiscard]] session::SessionDefaults defaultsOf(const std::string& source,
                                                      const scene::Scene& scene) const;
    [[nodiscard]] std::vector<session::OfferedLook> looksOf(const std::string& source,
                                                            const scene::Scene& scene) const;

    const ServeOptions options_;
    const bool device_is_cpu_;
    const std::string device_name_;
};

} // namespace froxel::app
