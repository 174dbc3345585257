// Light from around: what surfaces see of it takes the ambient light's place, after their loop over
// lights. It has no pass of its own.
#pragma once

#include "interface/environment_io.h"
#include "render/device/unit_costs.h"
#include "render/frame/step_plan.h"
#include "render/steps/environment_maps.h"

namespace froxel::render {

// What a pixel sees of it, seconds. On lavapipe, two cores: 3e-8 in compute, up to 1.5e-7 in
// fragments. Of a GPU an estimate by the texels that it reads.
inline constexpr Measured<double> kEnvironmentLookup{1e-7, 5e-11};

// Whether the frame's surfaces are lit by it.
[[nodiscard]] bool hasEnvironment(const settings::ViewSettings& settings);

[[nodiscard]] io::Environment makeEnvironment(const settings::Environment& settings,
                                              const settings::Camera& camera,
                                              const environment::Diffuse& matt);

} // namespace froxel::render
