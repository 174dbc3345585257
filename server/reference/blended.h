// Triangles that pixels see and that something shows through, found by ray: blended ones, and those
// that transmit light.
#pragma once

#include "reference/geometry.h"
#include "scene/scene.h"
#include "settings/settings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::reference {

struct BlendedHit {
    uint32_t instance = 0;
    uint32_t primitive = 0;
    uint32_t triangle = 0;
    PlanePoint point;
};

class BlendedSurfaces {
  public:
    BlendedSurfaces(const scene::Scene& scene,
                    std::span<const Placement> placements,
                    const settings::Camera& camera,
                    const settings::Size& size);

    // The nearest last.
    [[nodiscard]] std::span<const BlendedHit> at(uint32_t x, uint32_t y) const {
        return hits_[size_t{y} * size_.width_px + x];
    }

  private:
    // side: Placement's
    void addTriangle(const TreeTriangle& triangle, double side, bool both_sides);

    PixelRays rays_;
    settings::Size size_;
    double near_m_;
    std::vector<std::vector<BlendedHit>> hits_; // [height][width]
};

} // namespace froxel::reference
