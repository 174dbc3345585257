#include "reference/blended.h"

#include <algorithm>
#include <cmath>

namespace froxel::reference {
namespace {

// A pixel's centre on an edge that two triangles share meets both within rounding.
constexpr double kEdge = 1e-11;

double edgeDistance(const glm::dvec2& w) {
    return std::min({w.x, w.y, 1 - w.x - w.y});
}

// Whether two hits are one point of an edge that their triangles share.
bool sameEdge(const BlendedHit& a, const BlendedHit& b) {
    return a.instance == b.instance && a.primitive == b.primitive &&
           edgeDistance(a.point.weights) < kEdge && edgeDistance(b.point.weights) < kEdge &&
           std::abs(a.point.distance - b.point.distance) < 1e-9 * a.point.distance;
}

struct PixelBox {
    glm::dvec2 low{0};
    glm::dvec2 high{0};
};

// The pixels that a triangle may cover: all of them where a corner is behind the eye.
PixelBox pixelsOf(const PixelRays& rays, const Triangle& t, const settings::Size& size) {
    const glm::dvec2 end(size.width_px, size.height_px);
    PixelBox box{end, glm::dvec2(0)};
    for (const auto& corner : {t.corner, t.corner + t.edge1, t.corner + t.edge2}) {
        double along = 0;
        const glm::dvec2 at = rays.project(corner, along);
        if (!rays.parallel() && !(along > 0)) {
            return {glm::dvec2(0), end};
        }
        box.low = glm::min(box.low, at - 1.0);
        box.high = glm::max(box.high, at + 1.0);
    }
    return {glm::max(box.low, glm::dvec2(0)), glm::min(box.high, end)};
}

} // namespace

BlendedSurfaces::BlendedSurfaces(const scene::Scene& scene,
                                 std::span<const Placement> placements,
                                 const settings::Camera& camera,
                                 const settings::Size& size)
    : rays_(camera, size), size_(size), near_m_(camera.near_m),
      hits_(size_t{size.width_px} * size.height_px) {
    for (const TreeTriangle& t : trianglesOf(scene, placements, isLayered)) {
        const auto& primitive =
            scene.meshes[scene.instances[t.instance].mesh].primitives[t.primitive];
        addTriangle(t, placements[t.instance].side,
                    scene.materials[primitive.material].double_sided);
    }
    for (auto& hits : hits_) {
        std::stable_sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
            return a.point.distance > b.point.distance;
        });
    }
}

void BlendedSurfaces::addTriangle(const TreeTriangle& of, double side, bool both_sides) {
    const Triangle& triangle = of.placed;
    BlendedHit hit{of.instance, of.primitive, of.triangle, {}};
    const glm::dvec3 front = glm::cross(triangle.edge1, triangle.edge2) * side;
    const PixelBox box = pixelsOf(rays_, triangle, size_);
    for (auto y = static_cast<uint32_t>(box.low.y); y < box.high.y; ++y) {
        for (auto x = static_cast<uint32_t>(box.low.x); x < box.high.x; ++x) {
            const Ray ray = rays_.through(x, y);
            hit.point = meetPlane(ray, triangle);
            const bool seen = both_sides || glm::dot(front, ray.direction) < 0;
            if (!seen || !hit.point.met || edgeDistance(hit.point.weights) < -kEdge ||
                hit.point.distance < near_m_) {
                continue;
            }
            auto& hits = hits_[size_t{y} * size_.width_px + x];
            if (std::none_of(hits.begin(), hits.end(),
                             [&](const auto& other) { return sameEdge(hit, other); })) {
                hits.push_back(hit);
            }
        }
    }
}

} // namespace froxel::reference
