// Whether numbers are numbers, and not infinite.
#pragma once

#include <cmath>

namespace froxel {

[[nodiscard]] inline bool isFinite(float value) {
    return std::isfinite(value);
}

// All components of a glm vector.
template <class Vector>
[[nodiscard]] bool isFinite(const Vector& vector) {
    for (int i = 0; i < vector.length(); ++i) {
        if (!std::isfinite(vector[i])) {
            return false;
        }
    }
    return true;
}

} // namespace froxel
