// A closed surface, each of whose positions is there once: nothing of it is a border.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

namespace froxel::test {

struct Ball {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices; // counter-clockwise from outside
};

// About the origin, `radius` far from it along each way (a unit vector); `rings` from pole to pole.
[[nodiscard]] inline Ball makeBall(uint32_t rings,
                                   const std::function<float(const glm::vec3& way)>& radius) {
    constexpr float kPi = std::numbers::pi_v<float>;
    Ball ball;
    const uint32_t around = 2 * rings;
    const auto add = [&](uint32_t v, uint32_t u) {
        const float theta = kPi * static_cast<float>(v) / static_cast<float>(rings);
        const float phi = 2 * kPi * static_cast<float>(u) / static_cast<float>(around);
        const glm::vec3 way(std::sin(theta) * std::cos(phi), std::cos(theta),
                            std::sin(theta) * std::sin(phi));
        ball.positions.push_back(way * radius(way));
    };
    add(0, 0);
    for (uint32_t v = 1; v < rings; ++v) {
        for (uint32_t u = 0; u < around; ++u) {
            add(v, u);
        }
    }
    add(rings, 0);
    const auto at = [&](uint32_t v, uint32_t u) {
        return v == 0       ? 0
               : v == rings ? static_cast<uint32_t>(ball.positions.size()) - 1
                            : 1 + (v - 1) * around + u % around;
    };
    for (uint32_t v = 0; v < rings; ++v) {
        for (uint32_t u = 0; u < around; ++u) {
            if (v > 0) {
                ball.indices.insert(ball.indices.end(), {at(v, u), at(v, u + 1), at(v + 1, u)});
            }
            if (v + 1 < rings) {
                ball.indices.insert(ball.indices.end(),
                                    {at(v, u + 1), at(v + 1, u + 1), at(v + 1, u)});
            }
        }
    }
    return ball;
}

} // namespace froxel::test
