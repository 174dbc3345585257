#include "reference/occluders.h"

#include <algorithm>
#include <array>
#include <limits>

namespace froxel::reference {
namespace {

constexpr uint32_t kLeaf = 4;
constexpr double kNearest = 1e-6; // of the way, that is still the surface itself

glm::dvec3 middle(const Triangle& t) {
    return t.corner + (t.edge1 + t.edge2) / 3.0;
}

// Whether a ray meets a box on its way from 0 to 1.
bool meets(const BoundsD3& box, const Ray& ray, const glm::dvec3& inverse) {
    double low = 0;
    double high = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.min[axis] - ray.origin[axis]) * inverse[axis];
        const double b = (box.max[axis] - ray.origin[axis]) * inverse[axis];
        if (a != a || b != b) { // in the plane of a side, along it
            continue;
        }
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    return low <= high * (1 + 1e-12) + 1e-12;
}

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
    : scene_(scene), placements_(placements), materials_(materials) {
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const auto& primitives = scene.meshes[scene.instances[i].mesh].primitives;
        for (uint32_t p = 0; p < primitives.size(); ++p) {
            const auto& m = scene.materials[primitives[p].material];
            const bool glows = m.emissive != glm::vec3(0) &&
                               (m.unlit || m.emissive_texture.texture == scene::kNone);
            if (m.alpha_mode != scene::AlphaMode::kBlend && !glows) {
                add(i, p);
            }
        }
    }
    if (!casters_.empty()) {
        nodes_.reserve(casters_.size());
        build(0, static_cast<uint32_t>(casters_.size()));
    }
}

void Occluders::add(uint32_t instance, uint32_t primitive) {
    const auto& p = scene_.meshes[scene_.instances[instance].mesh].primitives[primitive];
    for (uint32_t t = 0; 3 * size_t{t} < p.indices.size(); ++t) {
        casters_.push_back({instance, primitive, t, placedTriangle(placements_[instance], p, t)});
    }
}

void Occluders::build(uint32_t first, uint32_t count) {
    const auto begin = casters_.begin() + first;
    BoundsD3 box;
    BoundsD3 middles;
    for (auto caster = begin; caster != begin + count; ++caster) {
        const Triangle& t = caster->placed;
        box.add(t.corner);
        box.add(t.corner + t.edge1);
        box.add(t.corner + t.edge2);
        middles.add(middle(t));
    }
    const auto own = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({box, first, count, 0});
    if (count <= kLeaf) {
        return;
    }
    const glm::dvec3 size = middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count, [axis](const auto& a, const auto& b) {
        return middle(a.placed)[axis] < middle(b.placed)[axis];
    });
    build(first, half);
    nodes_[own].right = static_cast<uint32_t>(nodes_.size());
    nodes_[own].count = 0;
    build(first + half, count - half);
}

bool Occluders::blocks(const Caster& caster, const Ray& ray) const {
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
    const glm::dvec3 inverse = 1.0 / ray.direction;
    std::array<uint32_t, 64> stack{};
    size_t depth = 0;
    if (!nodes_.empty()) {
        stack[depth++] = 0;
    }
    while (depth > 0) {
        const uint32_t at = stack[--depth];
        const Node& node = nodes_[at];
        if (!meets(node.box, ray, inverse)) {
            continue;
        }
        if (node.count == 0) {
            stack[depth++] = node.right;
            stack[depth++] = at + 1;
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (blocks(casters_[i], ray)) {
                return true;
            }
        }
    }
    return false;
}

} // namespace froxel::reference
