#include "environment/surroundings.h"

#include "environment/studio.h"

#include <utility>

namespace froxel::environment {
namespace {

// As fine as the finest level of the map.
constexpr uint32_t kStudioWidth_px = 4 * PrefilterSize{}.finest_px;

} // namespace

Surroundings surroundingsOf(LinearImage panorama) {
    Diffuse matt = diffuseOf(panorama);
    return {matt, prefilter(Pyramid(std::move(panorama)), {})};
}

const Surroundings& studioSurroundings() {
    static const Surroundings studio = surroundingsOf(studioPanorama(kStudioWidth_px));
    return studio;
}

} // namespace froxel::environment
