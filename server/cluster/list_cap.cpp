#include "cluster/list_cap.h"

#include "cluster/list_histogram.h"
#include "core/math.h"
#include "light/falloff.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace froxel::cluster {

namespace {

// In view space, whose y points up and whose z behind the eye.
BoundsD3 boxOf(const ClusterGrid& grid, const Cell& cell) {
    const bool perspective = grid.projection == settings::Projection::kPerspective;
    const double nearest = perspective ? cell.z0 : 1.0;
    const double farthest = perspective ? cell.z1 : 1.0;
    BoundsD3 box;
    for (const double depth : {nearest, farthest}) {
        box.add({cell.x0 * depth, -cell.y0 * depth, -cell.z0});
        box.add({cell.x1 * depth, -cell.y1 * depth, -cell.z1});
    }
    return box;
}

struct Candidate {
    double irradiance;
    uint32_t light;
};

// The stronger ones stay.
bool before(const Candidate& a, const Candidate& b) {
    return a.irradiance != b.irradiance ? a.irradiance > b.irradiance : a.light < b.light;
}

// Keeps the `cap` strongest of `all`, in ascending order at its front; returns what the others
// might have given.
double keepStrongest(std::span<uint32_t> all,
                     uint32_t cap,
                     const BoundsD3& box,
                     const light::FrameLights& lights,
                     std::vector<Candidate>& candidates) {
    candidates.clear();
    for (const uint32_t light : all) {
        candidates.push_back(
            {mostIrradiance(lights, lights.lights[light], box.min, box.max), light});
    }
    const auto kept = candidates.begin() + cap;
    std::nth_element(candidates.begin(), kept, candidates.end(), before);
    std::sort(candidates.begin(), kept,
              [](const auto& a, const auto& b) { return a.light < b.light; });
    std::transform(candidates.begin(), kept, all.begin(),
                   [](const Candidate& stays) { return stays.light; });
    return std::accumulate(kept, candidates.end(), 0.0,
                           [](double sum, const Candidate& gone) { return sum + gone.irradiance; });
}

using Dropped = ListCap::Dropped;

// Of one cluster, whose entries have their own place.
Dropped capList(const ClusterGrid& grid,
                const light::FrameLights& lights,
                uint32_t cap,
                uint32_t cluster,
                LightLists& lists,
                std::vector<Candidate>& candidates) {
    io::ClusterList& list = lists.clusters[cluster];
    if (list.count <= cap) {
        return {};
    }
    const uint32_t x = cluster % grid.size.x;
    const uint32_t line = cluster / grid.size.x;
    const Cell cell = grid.cell(x, line % grid.size.y, line / grid.size.y);
    const auto all = std::span(lists.indices).subspan(list.offset, list.count);
    const double lost = keepStrongest(all, cap, boxOf(grid, cell), lights, candidates);
    const Dropped dropped{lost, list.count - cap, 1};
    list.count = cap;
    return dropped;
}

} // namespace

double mostIrradiance(const light::FrameLights& lights,
                      const io::Light& light,
                      const glm::dvec3& box_min,
                      const glm::dvec3& box_max) {
    const glm::dvec3 position(light.position_view);
    const glm::dvec3 away = glm::clamp(position, box_min, box_max) - position;
    const double distance2 = glm::dot(away, away);
    const double share = distance2 * static_cast<double>(light.inv_radius2);
    const double window = std::max(0.0, 1.0 - share * share);
    // A rectangle's corners may be nearer than its centre.
    const double extent = static_cast<double>(light::extentOf(lights, light));
    const double nearest = std::max(std::sqrt(distance2) - extent, lights.nearest_m);
    return light::strongestChannel(light.color) * window * window / (nearest * nearest);
}

void ListCap::Dropped::add(const Dropped& other) {
    irradiance = std::max(irradiance, other.irradiance);
    count += other.count;
    list_count += other.list_count;
}

bool ListCap::advance(uint64_t entry_count) {
    const uint32_t all = lists_.all_lights ? 0 : grid_.clusterCount();
    const uint32_t first = next_;
    for (uint64_t count = 0; next_ < all && count < entry_count; ++next_) {
        const uint32_t listed = lists_.clusters[next_].count;
        count += listed > cap_ ? listed : 1;
    }
    capRange(first, next_);
    if (next_ < all) {
        return false;
    }
    if (all > 0) {
        close();
    }
    return true;
}

void ListCap::capRange(uint32_t first, uint32_t end) {
    constexpr uint32_t kAtOnce = 16; // clusters that one of the crew takes
    const auto step = std::clamp((end - first) / crew_.members(), 1U, kAtOnce);
    std::atomic<uint32_t> next = first;
    std::vector<Dropped> dropped(crew_.members());
    crew_.run(crew_.members(), [&](unsigned member) {
        std::vector<Candidate> candidates;
        for (uint32_t begin = next.fetch_add(step); begin < end; begin = next.fetch_add(step)) {
            for (uint32_t cluster = begin; cluster < std::min(begin + step, end); ++cluster) {
                dropped[member].add(capList(grid_, lights_, cap_, cluster, lists_, candidates));
            }
        }
    });
    for (const Dropped& part : dropped) {
        dropped_.add(part);
    }
}

void ListCap::close() {
    LightListStats& stats = lists_.stats;
    stats.dropped_irradiance = dropped_.irradiance;
    stats.dropped_count = dropped_.count;
    stats.capped_count = dropped_.list_count;

    // Lists only move towards the front.
    ListHistogram lengths;
    stats.largest = 0;
    uint32_t end = 0;
    for (io::ClusterList& list : lists_.clusters) {
        std::copy_n(lists_.indices.begin() + list.offset, list.count, lists_.indices.begin() + end);
        list.offset = end;
        end += list.count;
        lengths.add(list.count);
        stats.largest = std::max(stats.largest, list.count);
    }
    lists_.indices.resize(end);
    stats.entry_count = end;
    stats.p95 = lengths.p95(stats.largest);
    lists_.finishStats();
}

} // namespace froxel::cluster
