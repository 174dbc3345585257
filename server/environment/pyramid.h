// A panorama and coarser ones of it, for the mean radiance of cones of directions.
#pragma once

#include "core/linear_image.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace froxel::environment {

class Pyramid {
  public:
    explicit Pyramid(LinearImage panorama);

    // About the mean over so many sr about a direction: between two levels, linearly.
    [[nodiscard]] glm::dvec3 mean(const glm::dvec3& direction, double solid_angle) const;

    // The finest is the panorama, each other the next smaller power of two wide: at least 2 wide.
    // All have the same mean radiance.
    [[nodiscard]] std::span<const LinearImage> levels() const { return levels_; }

  private:
    std::vector<LinearImage> levels_;
};

} // namespace froxel::environment
