// The real frame source: render::Renderer on a device, behind the seam of frame_source.h.
#pragma once

#include "core/clock.h"
#include "render/device/memory_budget.h"
#include "render/device/scene_options.h"
#include "stream/frame_source.h"
#include "stream/jpeg_place.h"

#include <memory>

namespace froxel::gpu {
class Device;
}
namespace froxel::scene {
struct Scene;
}

namespace froxel::stream {

// For how long one frame may keep the device from others, by its estimate: half of the 250 ms, or
// 50 on a GPU, that nobody should wait. In storms pieces took up to twice what was expected.
inline constexpr Seconds kCpuPiece{0.125};
inline constexpr Seconds kGpuPiece{0.025};
// Likewise one pixel's loop over its lights, which nothing cuts.
inline constexpr Seconds kCpuLoop{0.125};
inline constexpr Seconds kGpuLoop{0.05};
// Likewise the host's part, between whose stages others get the thread. The longest of them, such
// as the placing of a million lights, take a tenth of a second.
inline constexpr Seconds kHostPart{0.03};

struct JpegOptions {
    JpegPlace place = JpegPlace::kHost;
    uint32_t encoder_count = 1; // of the host
};

// Moves the scene to the device and measures how fast that is where `camera` looks; frames that
// would take longer than `frame_limit` are refused. The scene is not needed afterwards. On the
// render thread, which must also end what comes back. Throws StartupError, vk::SystemError.
[[nodiscard]] std::unique_ptr<FrameSource>
makeRendererSource(std::unique_ptr<gpu::Device> device,
                   const scene::Scene& scene,
                   const settings::Camera& camera,
                   Seconds frame_limit,
                   const render::MemoryLimits& memory,
                   const render::SceneOptions& scenes = {},
                   const JpegOptions& jpeg = {});

} // namespace froxel::stream
