// A verdict on `froxel load` in JUnit's XML, as servers of continuous integration read it: a test
// case for each requirement, and one that no viewer failed. Pure.
#pragma once

#include "app/load_verdict.h"

#include <string>

namespace froxel::app {

// `seconds`: how long the run measured.
[[nodiscard]] std::string junitOf(const LoadVerdict& verdict, double seconds);

} // namespace froxel::app
