#include "render/frame/prepass_choice.h"

#include <algorithm>

namespace froxel::render {

bool prepassPays(const PrepassFacts& facts, const PrepassCosts& costs) {
    // Pixels without a surface count as covered: overdraw is then higher than it is taken for, and
    // the prepass pays where this says so.
    const double spared =
        std::max(0.0, facts.overdraw - 1) * static_cast<double>(facts.pixel_count);
    const double spared_ns = spared * (costs.fragment_ns + costs.light_ns * facts.lights);
    return spared_ns > costs.triangle_ns * static_cast<double>(facts.triangle_count);
}

} // namespace froxel::render
