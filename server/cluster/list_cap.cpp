#include "cluster/list_cap.h"

#include "cluster/list_histogram.h"
#include "core/math.h"
#include "light/falloff.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace froxel::cluster {

namespace {

// In view space, whose y points up and whose z behind the eye.
BoundsD3 boxOf(const ClusterGrid& grid, const Cell& cell) {
    const bool perspective = grid.projection == view::Projection::kPerspective;
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
    const double nearest = std::max(std::sqrt(distance2) - extent, light::kNearest_m);
    return light::strongestChannel(light.color) * window * window / (nearest * nearest);
}

void capLists(const ClusterGrid& grid,
              const light::FrameLights& lights,
              uint32_t cap,
              LightLists& lists) {
    if (lists.all_lights) {
        return;
    }
    LightListStats& stats = lists.stats;
    ListHistogram lengths;
    std::vector<Candidate> candidates;
    stats.largest = 0;
    uint32_t end = 0;
    for (uint32_t z = 0; z < grid.size.z; ++z) {
        for (uint32_t y = 0; y < grid.size.y; ++y) {
            for (uint32_t x = 0; x < grid.size.x; ++x) {
                io::ClusterList& list = lists.clusters[grid.clusterIndex(x, y, z)];
                const auto all = std::span(lists.indices).subspan(list.offset, list.count);
                if (list.count > cap) {
                    const double dropped = keepStrongest(all, cap, boxOf(grid, grid.cell(x, y, z)),
                                                         lights, candidates);
                    stats.dropped_irradiance = std::max(stats.dropped_irradiance, dropped);
                    stats.dropped_count += list.count - cap;
                    ++stats.capped_count;
                    list.count = cap;
                }
                // Lists only move towards the front.
                std::copy_n(all.begin(), list.count, lists.indices.begin() + end);
                list.offset = end;
                end += list.count;
                lengths.add(list.count);
                stats.largest = std::max(stats.largest, list.count);
            }
        }
    }
    lists.indices.resize(end);
    stats.entry_count = end;
    stats.p95 = lengths.p95(stats.largest);
    lists.finishStats();
}

} // namespace froxel::cluster
