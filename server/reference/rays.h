// The rays of a camera's pixels, and where they meet triangles.
#pragma once

#include "settings/camera.h"
#include "settings/settings.h"

namespace froxel::reference {

// Everything is in the world's axes, relative to the eye.
struct Ray {
    glm::dvec3 origin{0};
    glm::dvec3 direction{0}; // its length along the view axis is 1
};

class PixelRays {
  public:
    PixelRays(const settings::Camera& camera, const settings::Size& size);

    // Through the centre of a pixel, which need not lie inside the picture.
    [[nodiscard]] Ray through(int64_t x, int64_t y) const {
        return through(glm::dvec2(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5));
    }
    // Likewise, in pixels from the picture's top left corner.
    [[nodiscard]] Ray through(const glm::dvec2& at) const;
    // Pixels of a point ahead of the eye plane, from the picture's top left corner; `along` is its
    // distance along the view axis.
    [[nodiscard]] glm::dvec2 project(const glm::dvec3& point, double& along) const;
    [[nodiscard]] bool parallel() const { return parallel_; }

  private:
    glm::dmat3 world_from_view_;
    bool parallel_;
    glm::dvec2 half_extent_; // of the picture: at distance 1, or anywhere for parallel rays
    glm::dvec2 shift_;
    glm::dvec2 size_px_;
};

// A triangle by a corner and the edges from it.
struct Triangle {
    glm::dvec3 corner{0};
    glm::dvec3 edge1{0};
    glm::dvec3 edge2{0};
};

// The point corner + weights.x * edge1 + weights.y * edge2 of the plane.
struct PlanePoint {
    bool met = false;    // false: ray and plane are parallel
    double distance = 0; // along the view axis
    glm::dvec2 weights{0};

    [[nodiscard]] bool inside() const {
        return met && weights.x >= 0 && weights.y >= 0 && weights.x + weights.y <= 1;
    }
};
[[nodiscard]] PlanePoint meetPlane(const Ray& ray, const Triangle& triangle);

// A rasteriser snaps corners, so a triangle may cover a pixel whose centre lies just outside: there
// the plane goes on, by this share of the triangle at most. Farther outside (slivers, triangles
// seen edge-on) weights are moved into the triangle.
inline constexpr double kPlaneGoesOn = 0.05;
[[nodiscard]] glm::dvec2 clampToTriangle(const glm::dvec2& weights);

} // namespace froxel::reference
