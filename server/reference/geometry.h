// Triangles of a scene's instances where the eye sees them.
#pragma once

#include "reference/rays.h"
#include "reference/tree.h"
#include "scene/scene.h"

#include <array>
#include <span>
#include <vector>

namespace froxel::reference {

// An instance in the world's axes, relative to the eye.
struct Placement {
    Placement(const scene::Instance& instance, const glm::dvec3& eye_world);

    glm::dmat3 from_object;
    glm::dvec3 offset;
    glm::dmat3 normal_from_object; // the inverse transpose but for a positive factor
    double side;                   // -1: mirrored, which turns the winding round

    [[nodiscard]] glm::dvec3 position(const glm::vec3& object) const {
        return from_object * glm::dvec3(object) + offset;
    }
};

// One texture coordinate set over a triangle: an affine function of the weights.
struct UvPlane {
    glm::dvec2 corner{0};
    glm::dvec2 edge1{0};
    glm::dvec2 edge2{0};

    [[nodiscard]] glm::dvec2 at(const glm::dvec2& w) const { return corner + change(w); }
    [[nodiscard]] glm::dvec2 change(const glm::dvec2& w) const { return edge1 * w.x + edge2 * w.y; }
};

// What one pixel sees of a triangle.
struct SurfacePoint {
    glm::dvec3 position{0}; // relative to the eye
    glm::dvec3 to_eye{0};   // unit
    Triangle triangle;
    glm::dvec3 normal{0};  // interpolated, unit
    glm::dvec4 tangent{0}; // interpolated, with handedness; w of 0: none given
    glm::dvec4 color{1};
    std::array<UvPlane, 2> uv;
    glm::dvec2 weights{0};
    glm::dvec2 weights_dx{0}; // between the two columns of the pixel's 2 x 2 block, as rasterisers
    glm::dvec2 weights_dy{0}; // take derivatives; and between its rows
    bool front = true;        // the triangle's front faces the eye
};

[[nodiscard]] Triangle
placedTriangle(const Placement& placement, const scene::Primitive& primitive, uint32_t triangle);

// The point of a triangle that a pixel shows, at `hit` on the ray through its centre.
struct PixelHit {
    int64_t x = 0;
    int64_t y = 0;
    PlanePoint point;
};
[[nodiscard]] SurfacePoint surfaceAt(const PixelRays& rays,
                                     const PixelHit& hit,
                                     const Placement& placement,
                                     const scene::Primitive& primitive,
                                     uint32_t triangle);

// Where any ray meets a triangle: as by its pixel's, but that textures are looked up at a point.
[[nodiscard]] SurfacePoint surfaceAlong(const Ray& ray,
                                        const glm::dvec2& weights,
                                        const Placement& placement,
                                        const scene::Primitive& primitive,
                                        uint32_t triangle);

// Whether light passes a material as through glass: all of a metal's is stopped.
[[nodiscard]] bool transmits(const scene::Material& material);

// Whether what is behind a material shows through it: it is blended or transmits light.
[[nodiscard]] bool isLayered(const scene::Material& material);

// The triangles whose materials `takes`.
template <class Takes>
[[nodiscard]] std::vector<TreeTriangle>
trianglesOf(const scene::Scene& scene, std::span<const Placement> placements, Takes takes) {
    std::vector<TreeTriangle> all;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const auto& primitives = scene.meshes[scene.instances[i].mesh].primitives;
        for (uint32_t p = 0; p < primitives.size(); ++p) {
            if (!takes(scene.materials[primitives[p].material])) {
                continue;
            }
            for (uint32_t t = 0; 3 * size_t{t} < primitives[p].indices.size(); ++t) {
                all.push_back({i, p, t, placedTriangle(placements[i], primitives[p], t)});
            }
        }
    }
    return all;
}

} // namespace froxel::reference
