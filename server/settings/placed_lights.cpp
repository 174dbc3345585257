#include "settings/placed_lights.h"

#include "core/assert.h"

#include <algorithm>
#include <utility>

namespace froxel::settings {

PlacedLights::PlacedLights(std::vector<PlacedLight> lights) {
    const auto unordered = [](const PlacedLight& a, const PlacedLight& b) { return a.id >= b.id; };
    FROXEL_ASSERT(std::adjacent_find(lights.begin(), lights.end(), unordered) == lights.end(),
                  "ids of placed lights ascend");
    if (!lights.empty()) {
        lights_ = std::make_shared<const std::vector<PlacedLight>>(std::move(lights));
    }
}

std::span<const PlacedLight> PlacedLights::lights() const {
    return lights_ ? std::span<const PlacedLight>(*lights_) : std::span<const PlacedLight>();
}

const PlacedLight* PlacedLights::find(uint32_t id) const {
    const auto all = lights();
    const auto found =
        std::lower_bound(all.begin(), all.end(), id, [](const PlacedLight& light, uint32_t wanted) {
            return light.id < wanted;
        });
    return found != all.end() && found->id == id ? &*found : nullptr;
}

bool PlacedLights::operator==(const PlacedLights& other) const {
    const auto mine = lights();
    const auto theirs = other.lights();
    return lights_ == other.lights_ ||
           std::equal(mine.begin(), mine.end(), theirs.begin(), theirs.end());
}

} // namespace froxel::settings
