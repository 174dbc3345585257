// Cuts a spot's cone out of the cells that its ball meets.
#pragma once

#include "cluster/ball_sweep.h"
#include "cluster/cluster_grid.h"
#include "core/math.h"
#include "interface/assign_cone.h"
#include "light/frame_lights.h"

#include <optional>

namespace froxel::cluster {

// A cone with its apex at a light, in the axes of Cell, cut off at `range` (may be infinite).
class SpotCut {
  public:
    // None for a spot so wide (outer half angle above 80 degrees) that its cone cuts little: treat
    // it as a point. Direction: view space, unit.
    static std::optional<SpotCut> make(const glm::dvec3& apex_cell,
                                       const glm::dvec3& direction_view,
                                       const light::SpotCone& cone,
                                       double range);

    // A ball around what the spot can light, no larger than the light's own. Range must be finite.
    [[nodiscard]] Ball bound() const;
    // Whether the spot cannot light a point within the cell. False is not proof that it does.
    [[nodiscard]] bool misses(const Cell& cell, settings::Projection projection) const;
    [[nodiscard]] const io::Cone& cone() const { return cone_; }

  private:
    explicit SpotCut(const io::Cone& cone) : cone_(cone) {}

    io::Cone cone_;
};

} // namespace froxel::cluster
