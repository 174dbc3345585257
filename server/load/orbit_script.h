// The camera on a circle about its target.
#pragma once

#include "load/script.h"

namespace froxel::load {

// The pose of `state` turned about the vertical axis through its target. Pure.
[[nodiscard]] v1::SetCamera orbitPose(const v1::ViewState& state, double angle_rad);

class OrbitScript final : public Script {
  public:
    OrbitScript(const v1::ViewState& start, uint32_t viewer) : start_(start), viewer_(viewer) {}
    [[nodiscard]] std::optional<Step> next() override;

  private:
    const v1::ViewState start_;
    const uint32_t viewer_;
    uint64_t count_ = 0;
};

} // namespace froxel::load
