#include "motion/bounds.h"

#include <algorithm>

namespace froxel::motion {

namespace {

// Of the largest terms of a sum: some thirty roundings of single precision.
constexpr double kRounding = 2e-6;

BoundsD3 inDouble(const Bounds3& box) {
    return {glm::dvec3(box.min), glm::dvec3(box.max)};
}

void grow(BoundsD3& box, const glm::dvec3& by) {
    box.min -= by;
    box.max += by;
}

// The box with what the targets may add.
BoundsD3
morphed(const Bounds3& box, std::span<const Bounds3> targets, std::span<const double> weights) {
    BoundsD3 sum = inDouble(box);
    glm::dvec3 terms = glm::max(glm::abs(sum.min), glm::abs(sum.max));
    for (size_t i = 0; i < targets.size(); ++i) {
        const glm::dvec3 a = weights[i] * glm::dvec3(targets[i].min);
        const glm::dvec3 b = weights[i] * glm::dvec3(targets[i].max);
        sum.min += glm::min(a, b);
        sum.max += glm::max(a, b);
        terms += glm::max(glm::abs(a), glm::abs(b));
    }
    if (!targets.empty()) {
        grow(sum, kRounding * terms);
    }
    return sum;
}

BoundsD3 placed(const BoundsD3& box, const JointMatrix& joint) {
    const glm::dvec3 center = box.center();
    const glm::dvec3 half = box.size() * 0.5;
    const glm::dvec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
    BoundsD3 result;
    for (int r = 0; r < 3; ++r) {
        const glm::dvec4 row(joint.row[r]);
        const glm::dvec3 lengths = glm::abs(glm::dvec3(row));
        const double middle = glm::dot(glm::dvec3(row), center) + row.w;
        const double reach =
            glm::dot(lengths, half) + kRounding * (glm::dot(lengths, farthest) + glm::abs(row.w));
        result.min[r] = middle - reach;
        result.max[r] = middle + reach;
    }
    return result;
}

} // namespace

DeformExtent extentOf(const scene::Primitive& primitive,
                      const scene::Deformation& deformation,
                      size_t target_count) {
    DeformExtent extent;
    std::vector<Bounds3> joints;
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        extent.box.add(primitive.positions[v]);
        if (deformation.first_influence.empty()) {
            continue;
        }
        for (uint32_t i = deformation.first_influence[v]; i < deformation.first_influence[v + 1];
             ++i) {
            const uint32_t joint = deformation.influences[i].joint;
            joints.resize(std::max<size_t>(joints.size(), joint + size_t{1}));
            joints[joint].add(primitive.positions[v]);
        }
    }
    for (uint32_t joint = 0; joint < joints.size(); ++joint) {
        if (!joints[joint].empty()) {
            extent.joints.push_back({joint, joints[joint]});
        }
    }
    const bool morphs = !deformation.first_delta.empty();
    extent.targets.assign(morphs ? target_count : 0, Bounds3{glm::vec3(0), glm::vec3(0)});
    for (const scene::MorphDelta& delta : deformation.deltas) {
        extent.targets[delta.target].add(delta.position);
    }
    return extent;
}

BoundsD3
boundsOf(const DeformExtent& extent, std::span<const double> weights, const SkinPose* skin) {
    if (skin == nullptr) {
        return morphed(extent.box, extent.targets, weights);
    }
    BoundsD3 bounds;
    for (const DeformExtent::OfJoint& part : extent.joints) {
        bounds.add(placed(morphed(part.box, extent.targets, weights), skin->joints[part.joint]));
    }
    return bounds;
}

} // namespace froxel::motion
