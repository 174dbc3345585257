// The real frame source: render::Renderer on a device, behind the seam of frame_source.h.
#pragma once

#include "stream/frame_source.h"

#include <memory>

namespace froxel::gpu {
class Device;
}
namespace froxel::scene {
struct Scene;
}

namespace froxel::stream {

// Moves the scene to the device; the scene is not needed afterwards. On the render thread, which
// must also end what comes back. Throws StartupError, vk::SystemError.
[[nodiscard]] std::unique_ptr<FrameSource> makeRendererSource(std::unique_ptr<gpu::Device> device,
                                                              const scene::Scene& scene);

} // namespace froxel::stream
