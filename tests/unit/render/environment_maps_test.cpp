#include "render/steps/environment.h"
#include "settings/camera.h"

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace froxel::render {
namespace {

constexpr uint32_t kFaces = 6;

// Every texel of every level has a value of its own.
environment::Prefiltered numbered() {
    environment::Prefiltered glossy;
    float next = 0;
    for (uint32_t level = 0; level < io::kEnvironmentLevels; ++level) {
        environment::CubeLevel made{io::kEnvironmentSize >> level, 0, {}};
        for (uint32_t i = 0; i < kFaces * made.size_px * made.size_px; ++i, ++next) {
            made.rgb.insert(made.rgb.end(), 3, next);
        }
        glossy.levels.push_back(std::move(made));
    }
    return glossy;
}

TEST(EnvironmentMaps, Texels_StandLevelByLevelAndFaceByFace) {
    const auto glossy = numbered();
    const auto texels = texelsOf(glossy);
    ASSERT_EQ(texels.size(), io::environmentTexel(io::kEnvironmentLevels));
    for (uint32_t level = 0; level < io::kEnvironmentLevels; ++level) {
        const auto& from = glossy.levels[level];
        const uint32_t size = from.size_px;
        for (uint32_t face = 0; face < kFaces; ++face) {
            for (const glm::uvec2 at : {glm::uvec2(0, 0), {size - 1, 0}, {1, size - 1}}) {
                const uint32_t place = io::environmentTexel(level) +
                                       (face * (size + 2) + at.y + 1) * (size + 2) + at.x + 1;
                EXPECT_EQ(texels[place].x, from.rgb[3 * ((face * size + at.y) * size + at.x)])
                    << level << " " << face;
            }
        }
    }
}

// Right of +X's face is -Z's left edge, below +Z's face the top of -Y's (Vulkan 1.3, "Cube Map Face
// Selection").
TEST(EnvironmentMaps, Border_IsTheNeighbours) {
    const auto glossy = numbered();
    const auto texels = texelsOf(glossy);
    const auto& level = glossy.levels[5];
    const auto bordered = [&](uint32_t face, uint32_t x, uint32_t y) {
        return texels[io::environmentTexel(5) + (face * 6 + y) * 6 + x].x;
    };
    const auto own = [&](uint32_t face, uint32_t x, uint32_t y) {
        return level.rgb[3 * ((face * 4 + y) * 4 + x)];
    };
    for (uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(bordered(0, 5, i + 1), own(5, 0, i));
        EXPECT_EQ(bordered(4, i + 1, 5), own(3, i, 0));
    }
}

// Turned by a quarter, what was ahead (+Z) comes to +X.
TEST(EnvironmentMaps, Rotation_TurnsWhatIsAheadToTheRight) {
    const settings::Camera along_axes;
    const auto made = makeEnvironment(
        {.light = settings::EnvironmentLight::kStudio, .rotation_deg = 90, .strength = 3},
        along_axes, {.terms = {glm::dvec3(1, 2, 3)}});
    const glm::vec3 seen = made.map_from_view * glm::vec3(1, 0, 0);
    EXPECT_NEAR(seen.x, 0, 1e-6);
    EXPECT_EQ(seen.y, 0);
    EXPECT_NEAR(seen.z, 1, 1e-6);
    EXPECT_EQ(made.matt[0], glm::vec3(3, 6, 9));
    EXPECT_EQ(made.strength, 3);
}

} // namespace
} // namespace froxel::render
