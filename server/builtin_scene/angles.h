// Angles in radians.
#pragma once

#include <glm/gtc/constants.hpp>

namespace froxel::builtin_scene {

inline constexpr float kPi = glm::pi<float>();
inline constexpr float kTwoPi = glm::two_pi<float>();

} // namespace froxel::builtin_scene
