#include "reference/geometry.h"

#include <cmath>

namespace froxel::reference {
namespace {

// Corner, and edges from it, of an attribute.
template <class Vec, class Attribute>
std::array<Vec, 3> cornersOf(const std::vector<Attribute>& values,
                             const scene::Primitive& primitive,
                             uint32_t triangle) {
    const uint32_t* index = &primitive.indices[3 * size_t{triangle}];
    return {Vec(values[index[0]]), Vec(values[index[1]]), Vec(values[index[2]])};
}

template <class Vec>
Vec interpolated(const std::array<Vec, 3>& corners, const glm::dvec2& w) {
    return corners[0] + (corners[1] - corners[0]) * w.x + (corners[2] - corners[0]) * w.y;
}

UvPlane uvPlane(const std::vector<glm::vec2>& uv, const scene::Primitive& primitive, uint32_t t) {
    if (uv.empty()) {
        return {};
    }
    const auto corners = cornersOf<glm::dvec2>(uv, primitive, t);
    return {corners[0], corners[1] - corners[0], corners[2] - corners[0]};
}

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0 ? v / length : otherwise;
}

// Tangents are placed corner by corner, made unit, then interpolated.
glm::dvec4 tangentAt(const Placement& placement,
                     const scene::Primitive& primitive,
                     uint32_t triangle,
                     const glm::dvec2& w) {
    if (primitive.tangents.empty()) {
        return glm::dvec4(0);
    }
    auto corners = cornersOf<glm::dvec4>(primitive.tangents, primitive, triangle);
    for (auto& corner : corners) {
        const glm::dvec3 placed = placement.from_object * glm::dvec3(corner);
        corner = glm::dvec4(unitOr(placed, glm::dvec3(0)), corner.w * placement.side);
    }
    return interpolated(corners, w);
}

// Change of the weights inside the pixel's block along one axis of the picture.
glm::dvec2 weightsChange(const PixelRays& rays,
                         const Triangle& triangle,
                         const PixelHit& hit,
                         glm::i64vec2 step) {
    const glm::i64vec2 at(hit.x, hit.y);
    const bool second = (step.x * at.x + step.y * at.y) % 2 != 0;
    const glm::i64vec2 other = second ? at - step : at + step;
    const auto met = meetPlane(rays.through(other.x, other.y), triangle).weights;
    return second ? hit.point.weights - met : met - hit.point.weights;
}

} // namespace

Placement::Placement(const scene::Instance& instance, const glm::dvec3& eye_world)
    : from_object(instance.world_from_object),
      offset(glm::dvec3(instance.world_from_object[3]) - eye_world) {
    const glm::dmat3& m = from_object;
    side = glm::determinant(m) < 0 ? -1 : 1;
    // Cofactors: the inverse transpose times the determinant, there for flattened instances too.
    normal_from_object =
        glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])) * side;
}

Triangle
placedTriangle(const Placement& placement, const scene::Primitive& primitive, uint32_t triangle) {
    const auto object = cornersOf<glm::dvec3>(primitive.positions, primitive, triangle);
    return {placement.from_object * object[0] + placement.offset,
            placement.from_object * (object[1] - object[0]),
            placement.from_object * (object[2] - object[0])};
}

SurfacePoint surfaceAlong(const Ray& ray,
                          const glm::dvec2& weights,
                          const Placement& placement,
                          const scene::Primitive& primitive,
                          uint32_t triangle) {
    SurfacePoint p;
    p.triangle = placedTriangle(placement, primitive, triangle);
    p.weights = weights;
    p.position =
        p.triangle.corner + p.triangle.edge1 * p.weights.x + p.triangle.edge2 * p.weights.y;
    p.to_eye = glm::normalize(-ray.direction);
    const glm::dvec3 across = glm::cross(p.triangle.edge1, p.triangle.edge2) * placement.side;
    p.front = glm::dot(across, ray.direction) < 0;
    p.normal = unitOr(
        placement.normal_from_object *
            interpolated(cornersOf<glm::dvec3>(primitive.normals, primitive, triangle), p.weights),
        unitOr(across, glm::dvec3(0, 1, 0)));
    p.tangent = tangentAt(placement, primitive, triangle, p.weights);
    if (!primitive.colors.empty()) {
        p.color =
            interpolated(cornersOf<glm::dvec4>(primitive.colors, primitive, triangle), p.weights);
    }
    p.uv = {uvPlane(primitive.uv0, primitive, triangle),
            uvPlane(primitive.uv1, primitive, triangle)};
    return p;
}

SurfacePoint surfaceAt(const PixelRays& rays,
                       const PixelHit& hit,
                       const Placement& placement,
                       const scene::Primitive& primitive,
                       uint32_t triangle) {
    const Ray ray = rays.through(hit.x, hit.y);
    SurfacePoint p =
        surfaceAlong(ray, clampToTriangle(hit.point.weights), placement, primitive, triangle);
    p.to_eye = glm::normalize(rays.parallel() ? -ray.direction : -p.position);
    p.weights_dx = weightsChange(rays, p.triangle, hit, {1, 0});
    p.weights_dy = weightsChange(rays, p.triangle, hit, {0, 1});
    return p;
}

bool transmits(const scene::Material& m) {
    const bool metal = m.metallic == 1 && m.metallic_roughness_texture.texture == scene::kNone;
    return m.transmission.strength > 0 && !m.unlit && !metal;
}

bool isLayered(const scene::Material& m) {
    return m.alpha_mode == scene::AlphaMode::kBlend || transmits(m);
}

} // namespace froxel::reference
