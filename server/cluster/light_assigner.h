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
    friend class LightAssignment;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// LightAssigner::assign(), a part at a time: the same lists. What it is made from must stay as it
// is. An assigner has one under way, which takes up to 20 bytes an entry until its end; whoever
// comes meanwhile helps that one along, so that nobody waits for a viewer who does not come back.
class LightAssignment {
  public:
    LightAssignment(LightAssigner& assigner,
                    const ClusterGrid& grid,
                    const light::FrameLights& lights,
                    LightLists& out)
        : assigner_(assigner), grid_(grid), lights_(lights), out_(out) {}
    ~LightAssignment(); // gives up what is under way
    LightAssignment(const LightAssignment&) = delete;
    LightAssignment& operator=(const LightAssignment&) = delete;

    // Goes through about so many more lights and entries, its own or of the one that is under way:
    // whether its own lists are whole. Until then they are of no use.
    [[nodiscard]] bool advance(uint64_t work);

  private:
    LightAssigner& assigner_;
    const ClusterGrid& grid_;
    const light::FrameLights& lights_;
    LightLists& out_;
    bool done_ = false;
};

} // namespace froxel::cluster
