// Conventions: right-handed, metres, Y up (glTF axes); reversed-Z with infinite far, depth 0..1;
// column-major matrices named target_from_source; vectors say their space (position_world).
// World positions are double on the host; the GPU sees eye-relative view space in float.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <limits>

namespace froxel {

// Axis-aligned bounds; empty until the first point is added.
template <class Vec>
struct Bounds {
    using Scalar = typename Vec::value_type;
    Vec min{std::numeric_limits<Scalar>::infinity()};
    Vec max{-std::numeric_limits<Scalar>::infinity()};

    void add(const Vec& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void add(const Bounds& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    [[nodiscard]] bool empty() const { return !(min.x <= max.x); }
    [[nodiscard]] Vec size() const { return empty() ? Vec(0) : max - min; }
    [[nodiscard]] Vec center() const { return (min + max) * Scalar(0.5); }
    bool operator==(const Bounds&) const = default;
};

using Bounds3 = Bounds<glm::vec3>;
using BoundsD3 = Bounds<glm::dvec3>;

} // namespace froxel
