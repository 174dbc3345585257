#include "reference/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace froxel::reference {
namespace {

bool isLit(const scene::Scene& scene, const VisibleTriangle& seen) {
    if (seen.instance == VisibleTriangle::kNothing) {
        return false;
    }
    const auto& mesh = scene.meshes[scene.instances[seen.instance].mesh];
    return !scene.materials[mesh.primitives[seen.primitive].material].unlit;
}

} // namespace

double
meteredFactor(const scene::Scene& scene, const LinearImage& picture, const Visibility& visibility) {
    constexpr double kDarkest_ev = -16;
    constexpr double kBrightest_ev = 16;
    std::vector<double> levels_ev;
    for (size_t i = 0; i < visibility.pixels.size(); ++i) {
        const float* rgb = &picture.rgb[3 * i];
        const double luminance =
            glm::dot(glm::dvec3(rgb[0], rgb[1], rgb[2]), glm::dvec3(0.2126, 0.7152, 0.0722));
        const double level_ev = std::log2(luminance);
        if (level_ev >= kDarkest_ev && isLit(scene, visibility.pixels[i])) {
            levels_ev.push_back(std::min(level_ev, kBrightest_ev));
        }
    }
    if (levels_ev.empty()) {
        return 1;
    }
    std::ranges::sort(levels_ev);
    const auto dropped = static_cast<ptrdiff_t>(levels_ev.size() / 10);
    const auto kept = static_cast<double>(levels_ev.size() - 2 * static_cast<size_t>(dropped));
    const double mean_ev =
        std::accumulate(levels_ev.begin() + dropped, levels_ev.end() - dropped, 0.0) / kept;
    return std::exp2(std::clamp(std::log2(0.18) - mean_ev, -10.0, 10.0));
}

} // namespace froxel::reference
