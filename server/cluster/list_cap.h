// Shorter lists: error for speed, on purpose, and told.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/crew.h"
#include "cluster/light_assigner.h"
#include "light/frame_lights.h"

namespace froxel::cluster {

// More than a light can add to the irradiance of a surface anywhere in a box: its strongest channel
// times its falloff at the nearest point of the box; cones are left out. Positions are in view
// space. 0 where the box is out of its reach.
[[nodiscard]] double mostIrradiance(const light::FrameLights& lights,
                                    const io::Light& light,
                                    const glm::dvec3& box_min,
                                    const glm::dvec3& box_max);

// Leaves in each list the `cap` > 0 lights of most mostIrradiance() in the cluster's box, the first
// ones where several have as much; indices still ascend, and lists still follow each other. Fills
// the statistics anew, with what was dropped. Lists that name all lights stay as they are. The
// result does not depend on how many the crew are, nor on how many entries are capped at once. What
// it was made from must stay as it is until the end.
class ListCap {
  public:
    ListCap(const ClusterGrid& grid,
            const light::FrameLights& lights,
            uint32_t cap,
            Crew& crew,
            LightLists& lists)
        : grid_(grid), lights_(lights), cap_(cap), crew_(crew), lists_(lists) {}
    // Goes through about so many more entries, or short lists: whether all is done. Until then the
    // lists are of no use.
    [[nodiscard]] bool advance(uint64_t entry_count = UINT64_MAX);

    struct Dropped {
        double irradiance = 0; // at most in any one cluster
        uint64_t count = 0;
        uint32_t list_count = 0;
        void add(const Dropped& other);
    };

  private:
    void capRange(uint32_t first, uint32_t end); // clusters
    void close();

    const ClusterGrid& grid_;
    const light::FrameLights& lights_;
    const uint32_t cap_;
    Crew& crew_;
    LightLists& lists_;
    uint32_t next_ = 0; // cluster
    Dropped dropped_;
};

} // namespace froxel::cluster
