#include "builtin_scene/bay.h"
#include "builtin_scene/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace froxel::builtin_scene {
namespace {

// Bands across half the hall, from the axis outward: where each ends, and of what it is.
struct Band {
    float end_z;
    Surface surface;
};
constexpr std::array<Band, 6> kBands = {
    Band{3.00F, Surface::kInlay},        Band{3.10F, Surface::kRosso},
    Band{3.36F, Surface::kVerde},        Band{3.46F, Surface::kRosso},
    Band{4.55F, Surface::kPavonazzetto}, Band{8.20F, Surface::kHerringbone}};
// Bands about a line of columns, half of them, in the nave.
constexpr std::array<Band, 2> kCross = {Band{0.17F, Surface::kGiallo},
                                        Band{0.25F, Surface::kRosso}};

Surface surfaceAt(float x, float z) {
    const float across = std::abs(z);
    const Band* band = std::find_if(kBands.begin(), kBands.end() - 1,
                                    [&](const Band& b) { return across < b.end_z; });
    if (band->surface != Surface::kInlay) {
        return band->surface;
    }
    const float line = (x + plan::kHalfLength) / plan::kBay;
    const float off = std::abs(line - std::round(line)) * plan::kBay;
    for (const Band& cross : kCross) {
        if (off < cross.end_z) {
            return cross.surface;
        }
    }
    return Surface::kInlay;
}

} // namespace

MeshBuilder groundFloor() {
    // Every band's edge cuts the whole floor, so that neighbours share their corners.
    std::vector<float> xs{-plan::kHalfLength - 0.4F, plan::kHalfLength + 0.6F};
    for (uint32_t line = 0; line <= plan::kBays; ++line) {
        for (const Band& cross : kCross) {
            xs.push_back(plan::lineX(line) - cross.end_z);
            xs.push_back(plan::lineX(line) + cross.end_z);
        }
    }
    std::vector<float> zs;
    for (const Band& band : kBands) {
        zs.push_back(band.end_z);
        zs.push_back(-band.end_z);
    }
    std::sort(xs.begin(), xs.end());
    std::sort(zs.begin(), zs.end());
    MeshBuilder floor(Surface::kInlay);
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
        for (size_t j = 0; j + 1 < zs.size(); ++j) {
            const glm::vec2 low(xs[i], zs[j]);
            const glm::vec2 high(xs[i + 1], zs[j + 1]);
            const Surface surface = surfaceAt(0.5F * (low.x + high.x), 0.5F * (low.y + high.y));
            floor.use(surface);
            // The inlay's tiles start at each panel's corner; the rest is laid through.
            const glm::vec2 origin = surface == Surface::kInlay ? low : glm::vec2(0);
            const auto corner = [&](float x, float z) {
                return floor.vertex({{x, 0, z}, {0, 1, 0}, glm::vec2(x, z) - origin});
            };
            floor.quad(corner(low.x, high.y), corner(high.x, high.y), corner(high.x, low.y),
                       corner(low.x, low.y));
        }
    }
    return floor;
}

} // namespace froxel::builtin_scene
