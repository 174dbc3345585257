#include "reference/occluders.h"

namespace froxel::reference {
namespace {

constexpr double kNearest = 1e-6; // of the way, that is still the surface itself

// Whether a ray meets a triangle between its two ends.
bool lies(const PlanePoint& hit) {
    return hit.inside() && hit.distance > kNearest && hit.distance < 1;
}

} // namespace

Occluders::Occluders(const scene::Scene& scene,
                     std::span<const Placement> placements,
                     const Materials& materials)
    : scene_(scene), placements_(placements), materials_(materials), tree_(casters()),
      transmissive_(trianglesOf(scene, placements, transmits)) {}

std::vector<TreeTriangle> Occluders::casters() const {
    return trianglesOf(scene_, placements_, [](const scene::Material& m) {
        const bool glows =
            m.emissive != glm::vec3(0) && (m.unlit || m.emissive_texture.texture == scene::kNone);
        return !isLayered(m) && !glows;
    });
}

SurfacePoint
Occluders::pointOf(const TreeTriangle& of, const Ray& ray, const PlanePoint& hit) const {
    return surfaceAlong(ray, hit.weights, placements_[of.instance], primitiveOf(of), of.triangle);
}

bool Occluders::isCutOut(uint32_t index, const SurfacePoint& point) const {
    const auto& material = scene_.materials[index];
    return material.alpha_mode == scene::AlphaMode::kMask &&
           materials_.alpha(index, point) < static_cast<double>(material.alpha_cutoff);
}

bool Occluders::blocks(const TreeTriangle& caster, const Ray& ray) const {
    const PlanePoint hit = meetPlane(ray, caster.placed);
    return lies(hit) && !isCutOut(primitiveOf(caster).material, pointOf(caster, ray, hit));
}

bool Occluders::between(const glm::dvec3& from, const glm::dvec3& to) const {
    const Ray ray{from, to - from};
    return tree_.any(ray, 1, [&](const TreeTriangle& caster) { return blocks(caster, ray); });
}

double Occluders::shareOf(const TreeTriangle& surface, const Ray& ray) const {
    const PlanePoint hit = meetPlane(ray, surface.placed);
    if (!lies(hit)) {
        return 1;
    }
    const uint32_t material = primitiveOf(surface).material;
    const SurfacePoint point = pointOf(surface, ray, hit);
    if (isCutOut(material, point)) {
        return 1;
    }
    const Surface s = materials_.at(material, point);
    const Transmission& t = s.transmission;
    glm::dvec3 color = s.base_color * (t.strength * (1 - s.metallic));
    if (scene_.materials[material].volume.thickness_m > 0) {
        color = glm::sqrt(color * glm::pow(t.attenuation, glm::dvec3(t.thickness)));
    }
    return glm::dot(glm::mix(glm::dvec3(1), color, s.alpha), glm::dvec3(0.2126, 0.7152, 0.0722));
}

double Occluders::passes(const glm::dvec3& from, const glm::dvec3& to) const {
    if (between(from, to)) {
        return 0;
    }
    const Ray ray{from, to - from};
    double share = 1;
    (void)transmissive_.any(ray, 1, [&](const TreeTriangle& surface) {
        share *= shareOf(surface, ray);
        return false;
    });
    return share;
}

} // namespace froxel::reference
