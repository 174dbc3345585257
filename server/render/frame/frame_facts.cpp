#include "render/frame/frame_facts.h"

#include "light/light_rig.h"

#include <algorithm>

namespace froxel::render {

double farthestDepth(const settings::Camera& camera, const BoundsD3& bounds) {
    double farthest = 0;
    for (uint32_t i = 0; i < 8 && !bounds.empty(); ++i) {
        const glm::dvec3 corner((i & 1U) != 0 ? bounds.max.x : bounds.min.x,
                                (i & 2U) != 0 ? bounds.max.y : bounds.min.y,
                                (i & 4U) != 0 ? bounds.max.z : bounds.min.z);
        farthest =
            std::max(farthest, -glm::dot(corner - camera.eye_world, camera.world_from_view[2]));
    }
    return farthest * 1.001;
}

bool equalRadii(const light::FrameLights& lights, const settings::Lights& settings) {
    const auto& radii = lights.radii_m;
    const bool seeded_alike =
        settings.cutoff <= 0 &&
        std::ranges::none_of(settings.placed.lights(), [&](const settings::PlacedLight& placed) {
            return light::standsForSeeded(settings, placed);
        });
    const uint32_t seeded_count = seeded_alike ? settings.count : 0;
    const size_t first = std::min<size_t>(seeded_count > 0 ? seeded_count - 1 : 0, radii.size());
    return std::all_of(radii.begin() + static_cast<std::ptrdiff_t>(first), radii.end(),
                       [&](float radius) { return radius == radii[first]; });
}

bool longLoops(const cluster::LightLists& lists,
               const light::FrameLights& lights,
               uint32_t subgroup_size) {
    const uint64_t longest =
        lists.clusters.empty() ? lights.lights.size() : uint64_t{lists.stats.largest};
    return longest * (subgroup_size + 1U) > 60'000;
}

} // namespace froxel::render
