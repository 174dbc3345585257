// Assigns point and spot lights to clusters on the host.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/crew.h"
#include "core/frame_stats.h"
#include "interface/light_io.h"
#include "light/frame_lights.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace froxel::cluster {

// A list for every cluster, in cluster order; light indices ascend within each and lists follow
// each other without gaps. Keep one LightLists and assign into it again: its buffers are reused.
struct LightLists {
    std::vector<io::ClusterList> clusters;
    std::vector<uint32_t> indices;
    LightListStats stats;
    // The lists would have passed the assigner's limit: every cluster names one shared list of all
    // lights instead. Exact, but slow; stats count it as it is shaded.
    bool all_lights = false;

    // Those of the statistics that follow from the others and from the buffers.
    void finishStats();
};

// Guarantee: where shading in fp32 finds a light's contribution other than 0 at a point of a
// cluster, the light is in that cluster's list. Lights are cut by a ball 1e-6 larger (of the radius
// and of the distance to the eye), spots by a cone with 2e-6 less cosine. Points are otherwise
// exact: a light is listed only where its ball meets the cell. A light without range limit is in
// every list, unless it is a spot and its cone misses the cell.
// The result does not depend on the number of threads. One call at a time.
class LightAssigner {
  public:
    // 128 MiB of indices: what every Vulkan device must be able to bind as one storage buffer.
    static constexpr uint64_t kDefaultMaxEntries = uint64_t{1} << 25U;

    // `threads` counts the calling one; at least 1.
    explicit LightAssigner(unsigned threads, uint64_t max_entries = kDefaultMaxEntries);
    ~LightAssigner();
    LightAssigner(const LightAssigner&) = delete;
    LightAssigner& operator=(const LightAssigner&) = delete;

    void assign(const ClusterGrid& grid, const light::FrameLights& lights, LightLists& out);
    // Its threads, between two calls.
    [[nodiscard]] Crew& crew();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::cluster
