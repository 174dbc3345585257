#include "environment/surroundings.h"

#include "environment/studio_table.h"

#include <algorithm>
#include <span>
#include <utility>

namespace froxel::environment {
namespace {

Surroundings studioFromTable() {
    const StudioTable table = studioTable();
    Surroundings studio;
    std::ranges::transform(table.matt, studio.matt.terms.begin(),
                           [](double term) { return glm::dvec3(term); });
    uint32_t size_px = PrefilterSize{}.finest_px;
    std::span<const float> left = table.texels;
    for (const double roughness : table.roughness) {
        CubeLevel level{size_px, roughness, {}};
        const size_t count = size_t{6} * size_px * size_px;
        for (const float texel : left.first(count)) {
            level.rgb.insert(level.rgb.end(), 3, texel);
        }
        left = left.subspan(count);
        studio.glossy.levels.push_back(std::move(level));
        size_px /= 2;
    }
    return studio;
}

} // namespace

Surroundings surroundingsOf(LinearImage panorama) {
    Diffuse matt = diffuseOf(panorama);
    return {matt, prefilter(Pyramid(std::move(panorama)), {})};
}

const Surroundings& studioSurroundings() {
    static const Surroundings studio = studioFromTable();
    return studio;
}

} // namespace froxel::environment
