// R2, the second reference: the picture as the formulas say, in double on the host, from what a
// device says it sees. Written apart from the shaders, so that it can catch them. Prices the
// G-buffer, depth reconstruction and fp32 arithmetic, not the light model.
#pragma once

#include "core/error.h"
#include "core/linear_image.h"
#include "scene/scene.h"
#include "view/settings.h"

#include <cstdint>
#include <vector>

namespace froxel::reference {

// One pixel's solid surface: which triangle of which placed mesh covers the pixel's centre.
struct VisibleTriangle {
    static constexpr uint32_t kNothing = 0xFFFFFFFF;
    uint32_t instance = kNothing; // index into scene.instances
    uint32_t primitive = 0;       // of the instance's mesh
    uint32_t triangle = 0;        // of the primitive: its indices 3 i, 3 i + 1, 3 i + 2
};

struct Visibility {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::vector<VisibleTriangle> pixels; // [height][width], top row first
};

// Shades every pixel with every light of `settings` at `time_s`. The ray through the pixel's centre
// meets the triangle in double; textures are filtered trilinearly in double by this room's own code.
// Runs on every hardware thread. Errors: kUnsupported names what this reference does not model.
[[nodiscard]] Result<LinearImage> shade(const scene::Scene& scene,
                                        const view::ViewSettings& settings,
                                        double time_s,
                                        const Visibility& visibility);

} // namespace froxel::reference
