#include "reference/occluders.h"

namespace froxel::reference {
namespace {

constexpr double kNearest = 1e-6; // of the way, that is still the surface itself

UvPlane uvOf(const std::vector<glm::vec2>& uv, const uint32_t* index) {
    if (uv.empty()) {
        return {};
    }
    const glm::dvec2 corner(uv[index[0]]);
    return {corner, glm::dvec2(uv[index[1]]) - corner, glm::dvec2(uv[index[2]]) - corner};
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
        return m.alpha_mode != scene::AlphaMode::kBlend && !transmits(m) && !glows;
    });
}

bool Occluders::blocks(const TreeTriangle& caster, const Ray& ray) const {
    const PlanePoint hit = meetPlane(ray, caster.placed);
    if (!hit.inside() || !(hit.distance > kNearest) || !(hit.distance < 1)) {
        return false;
    }
    const auto& p =
        scene_.meshes[scene_.instances[caster.instance].mesh].primitives[caster.primitive];
    const auto& material = scene_.materials[p.material];
    if (material.alpha_mode != scene::AlphaMode::kMask) {
        return true;
    }
    const uint32_t* index = &p.indices[3 * size_t{caster.triangle}];
    SurfacePoint point;
    point.weights = hit.weights;
    point.uv = {uvOf(p.uv0, index), uvOf(p.uv1, index)};
    if (!p.colors.empty()) {
        const glm::dvec4 corner(p.colors[index[0]]);
        point.color = corner + (glm::dvec4(p.colors[index[1]]) - corner) * hit.weights.x +
                      (glm::dvec4(p.colors[index[2]]) - corner) * hit.weights.y;
    }
    return materials_.alpha(p.material, point) >= static_cast<double>(material.alpha_cutoff);
}

bool Occluders::between(const glm::dvec3& from, const glm::dvec3& to) const {
    const Ray ray{from, to - from};
    return tree_.any(ray, 1, [&](const TreeTriangle& caster) { return blocks(caster, ray); });
}

double Occluders::shareOf(const TreeTriangle& surface, const Ray& ray) const {
    const PlanePoint hit = meetPlane(ray, surface.placed);
    if (!hit.inside() || !(hit.distance > kNearest) || !(hit.distance < 1)) {
        return 1;
    }
    const auto& p =
        scene_.meshes[scene_.instances[surface.instance].mesh].primitives[surface.primitive];
    const SurfacePoint point =
        surfaceAlong(ray, hit.weights, placements_[surface.instance], p, surface.triangle);
    const Surface s = materials_.at(p.material, point);
    const auto& material = scene_.materials[p.material];
    if (material.alpha_mode == scene::AlphaMode::kMask &&
        materials_.alpha(p.material, point) < static_cast<double>(material.alpha_cutoff)) {
        return 1;
    }
    const Transmission& t = s.transmission;
    glm::dvec3 color = s.base_color * (t.strength * (1 - s.metallic));
    if (material.volume.thickness_m > 0) {
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
