#include "builtin_scene/profile.h"

#include "builtin_scene/angles.h"
#include "core/assert.h"

#include <algorithm>
#include <cmath>

namespace froxel::builtin_scene {
namespace {

constexpr float kCreaseCosine = 0.60F; // 53 degrees: a torus in four steps is still round

// Outward normal of a step of a profile: the solid is on the left hand.
glm::vec2 rightOf(glm::vec2 step) {
    return glm::normalize(glm::vec2(step.y, -step.x));
}

float fraction(uint32_t i, uint32_t steps) {
    return static_cast<float>(i) / static_cast<float>(steps);
}

// A whole number of metres around, so that a texture of a metre or its parts closes on itself.
float aroundUv(float circumference_m) {
    return circumference_m < 0.75F ? 1.0F : std::round(circumference_m);
}

} // namespace

Profile& Profile::to(glm::vec2 end) {
    FROXEL_ASSERT(end != points_.back(), "a profile step has a length");
    points_.push_back(end);
    return *this;
}

Profile& Profile::arc(glm::vec2 offset, float bulge, uint32_t steps) {
    const glm::vec2 start = points_.back();
    const float half = 2.0F * std::atan(bulge); // half the arc's angle
    const float chord = glm::length(offset);
    const glm::vec2 along = offset / chord;
    const glm::vec2 outward = rightOf(offset);
    const float radius = 0.5F * chord / std::sin(half);
    const glm::vec2 centre = start + offset * 0.5F - outward * (radius * std::cos(half));
    for (uint32_t i = 1; i < steps; ++i) {
        const float angle = half * (2.0F * fraction(i, steps) - 1.0F);
        to(centre + radius * (std::sin(angle) * along + std::cos(angle) * outward));
    }
    return to(start + offset);
}

std::vector<std::vector<Profile::Point>> Profile::stretches(bool closed) const {
    const size_t count = points_.size();
    FROXEL_ASSERT(count >= 2, "a profile has a step");
    std::vector<glm::vec2> normals;
    for (size_t i = 0; i + 1 < count; ++i) {
        normals.push_back(rightOf(points_[i + 1] - points_[i]));
    }
    // The normal at a point seen from one of its two steps.
    const auto shared = [&](size_t step, size_t other) {
        const bool smooth = glm::dot(normals[step], normals[other]) > kCreaseCosine;
        return smooth ? glm::normalize(normals[step] + normals[other]) : normals[step];
    };
    std::vector<std::vector<Point>> result;
    float along = 0;
    for (size_t step = 0; step < normals.size(); ++step) {
        const bool first = step == 0;
        const bool last = step + 1 == normals.size();
        const size_t before = first ? (closed ? normals.size() - 1 : 0) : step - 1;
        const size_t after = last ? (closed ? 0 : step) : step + 1;
        const glm::vec2 start = shared(step, before);
        if (first || glm::dot(normals[step], normals[before]) <= kCreaseCosine) {
            result.push_back({{points_[step], start, along}});
        }
        along += glm::length(points_[step + 1] - points_[step]);
        result.back().push_back({points_[step + 1], shared(step, after), along});
    }
    return result;
}

void addLathe(MeshBuilder& mesh, const Profile& profile, uint32_t steps) {
    float widest = 0;
    for (const glm::vec2& point : profile.points()) {
        widest = std::max(widest, point.x);
    }
    const float around_m = aroundUv(kTwoPi * widest);
    for (const auto& stretch : profile.stretches()) {
        const auto rows = static_cast<uint32_t>(stretch.size() - 1);
        mesh.sheet(steps, rows, [&](uint32_t i, uint32_t j) {
            const Profile::Point& point = stretch[j];
            const float t = fraction(i, steps);
            const float angle = i == steps ? 0.0F : t * kTwoPi; // the seam closes exactly
            const glm::vec3 out(std::cos(angle), 0, -std::sin(angle));
            // Sums of steps miss the axis by a rounding error; a pole is one point.
            const float radius = point.position.x < 1e-6F ? 0.0F : point.position.x;
            return Vertex{out * radius + glm::vec3(0, point.position.y, 0),
                          out * point.normal.x + glm::vec3(0, point.normal.y, 0),
                          {t * around_m, -point.along_m}};
        });
    }
}

void addMoulding(MeshBuilder& mesh, const Profile& profile, float x0, float x1, uint32_t steps) {
    for (const auto& stretch : profile.stretches()) {
        const auto rows = static_cast<uint32_t>(stretch.size() - 1);
        mesh.sheet(steps, rows, [&](uint32_t i, uint32_t j) {
            const Profile::Point& point = stretch[j];
            const float x = x0 + (x1 - x0) * fraction(i, steps);
            return Vertex{{x, point.position.y, point.position.x},
                          {0, point.normal.y, point.normal.x},
                          {x, -point.along_m}};
        });
    }
}

void addLoft(MeshBuilder& mesh, const Profile& plan, const std::vector<glm::vec2>& scale_height) {
    const float around_m = [&] {
        float sum = 0;
        const auto& points = plan.points();
        for (size_t i = 1; i < points.size(); ++i) {
            sum += glm::length(points[i] - points[i - 1]);
        }
        return sum * scale_height.front().x;
    }();
    const float u_scale = aroundUv(around_m) / around_m * scale_height.front().x;
    const auto rows = static_cast<uint32_t>(scale_height.size() - 1);
    for (const auto& stretch : plan.stretches(true)) {
        const auto columns = static_cast<uint32_t>(stretch.size() - 1);
        mesh.sheet(columns, rows, [&](uint32_t i, uint32_t j) {
            const Profile::Point& point = stretch[i];
            const glm::vec2 flat = point.position * scale_height[j].x;
            return Vertex{{flat.x, scale_height[j].y, -flat.y},
                          {point.normal.x, 0, -point.normal.y},
                          {point.along_m * u_scale, -scale_height[j].y}};
        });
    }
}

void addTube(MeshBuilder& mesh,
             uint32_t steps,
             uint32_t sides,
             float radius_m,
             bool closed,
             const std::function<glm::vec3(float t)>& path) {
    struct Ring {
        glm::vec3 centre, side, up;
        float along_m;
    };
    std::vector<Ring> rings;
    for (uint32_t i = 0; i <= steps; ++i) {
        constexpr float kStep = 1.0F / 2048.0F;
        const float t = closed && i == steps ? 0.0F : fraction(i, steps);
        const glm::vec3 tangent = glm::normalize(path(t + kStep) - path(t - kStep));
        Ring ring{path(t), {}, {}, 0};
        if (rings.empty()) {
            const glm::vec3 axis =
                std::abs(tangent.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            ring.side = glm::normalize(glm::cross(tangent, axis));
        } else {
            const Ring& last = rings.back();
            ring.side = glm::normalize(last.side - tangent * glm::dot(last.side, tangent));
            ring.along_m = last.along_m + glm::length(ring.centre - last.centre);
        }
        ring.up = glm::cross(ring.side, tangent);
        rings.push_back(ring);
    }
    // Parallel transport comes home turned; spread the difference along a closed path.
    float twist = 0;
    if (closed) {
        const Ring& first = rings.front();
        const glm::vec3 end = rings.back().side;
        twist = -std::atan2(glm::dot(end, first.up), glm::dot(end, first.side));
    }
    mesh.sheet(steps, sides, [&](uint32_t i, uint32_t j) {
        const Ring& ring = rings[i];
        const bool home = closed && i == steps;
        const Ring& frame = home ? rings.front() : ring;
        const float turn = home ? 0.0F : twist * fraction(i, steps);
        const float angle = (j == sides ? 0.0F : fraction(j, sides) * kTwoPi) + turn;
        const glm::vec3 out = frame.side * std::cos(angle) + frame.up * std::sin(angle);
        return Vertex{frame.centre + out * radius_m,
                      out,
                      {ring.along_m, -fraction(j, sides) * std::max(0.25F, kTwoPi * radius_m)}};
    });
}

} // namespace froxel::builtin_scene
