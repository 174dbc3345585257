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
    : scene_(scene), placements_(placements), materials_(materials), tree_(casters()) {}

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

} // namespace froxel::reference
