#include "render/light_budget.h"

#include <spdlog/fmt/fmt.h>

namespace froxel::render {

Result<void> checkLightBudget(const view::Size& size, uint64_t lights_each, bool device_is_cpu) {
    const double most = device_is_cpu ? kMostPairsCpu : kMostPairsGpu;
    const double pairs =
        static_cast<double>(size.width_px) * size.height_px * static_cast<double>(lights_each);
    if (pairs <= most) {
        return {};
    }
    return Error{
        ErrorCode::kCapacity,
        fmt::format("a picture of {}x{} whose pixels loop over {} lights each takes {:.1e} "
                    "evaluations of lights; this device draws at most {:.1e} a frame: ask "
                    "for fewer or smaller lights, lists, or a smaller picture",
                    size.width_px, size.height_px, lights_each, pairs, most)};
}

} // namespace froxel::render
