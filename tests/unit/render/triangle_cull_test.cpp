#include "render/frame/triangle_cull.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace froxel::render {

namespace {

// Object space is clip space, w = 1; 64 x 64 pixels, so one unit is 32 pixels.
TriangleCull screen(bool cull_back = true) {
    return {.clip_from_object = glm::mat4(1),
            .half_size_px = {32, 32},
            .cull_back = cull_back,
            .mirrored = false};
}

bool kept(const TriangleCull& cull, const std::array<glm::vec3, 3>& corners) {
    const std::array<uint32_t, 4> words = {0, 1, 2, 0x020100};
    std::vector<uint32_t> out;
    appendVisibleTriangles(cull, {{.index_count = 3, .vertex_count = 3}, words}, corners, out);
    return !out.empty();
}

// Counter-clockwise as seen: y points down in clip space.
constexpr std::array<glm::vec3, 3> kFront = {glm::vec3{-0.5F, 0.5F, 0}, glm::vec3{0.5F, 0.5F, 0},
                                             glm::vec3{0, -0.5F, 0}};
constexpr std::array<glm::vec3, 3> kBack = {kFront[0], kFront[2], kFront[1]};

} // namespace

TEST(TriangleCull, FacingTheEye_IsKept) {
    EXPECT_TRUE(kept(screen(), kFront));
}

TEST(TriangleCull, FacingAway_GoesUnlessDoubleSidedOrMirrored) {
    EXPECT_FALSE(kept(screen(), kBack));
    EXPECT_TRUE(kept(screen(false), kBack));
    auto mirrored = screen();
    mirrored.mirrored = true;
    EXPECT_TRUE(kept(mirrored, kBack));
    EXPECT_FALSE(kept(mirrored, kFront));
}

TEST(TriangleCull, OutsideTheView_Goes) {
    auto away = kFront;
    for (auto& corner : away) {
        corner.x += 3;
    }
    EXPECT_FALSE(kept(screen(), away));
}

TEST(TriangleCull, BetweenPixelCentres_Goes) {
    // A tenth of a pixel wide, in the middle between two centres: these lie at odd multiples of
    // 1/64.
    std::array<glm::vec3, 3> tiny = kFront;
    for (auto& corner : tiny) {
        corner = corner * (0.2F / 32.0F) + glm::vec3(0, 0, 0);
    }
    EXPECT_FALSE(kept(screen(), tiny));
    for (auto& corner : tiny) {
        corner += glm::vec3(1.0F / 64.0F, 1.0F / 64.0F, 0);
    }
    EXPECT_TRUE(kept(screen(), tiny));
}

TEST(TriangleCull, CornerBehindTheEye_IsKept) {
    auto cull = screen();
    cull.clip_from_object[3][3] = 0; // w = z
    cull.clip_from_object[2][3] = 1;
    EXPECT_TRUE(kept(cull, {glm::vec3{0, 0, -1}, glm::vec3{1, 0, 1}, glm::vec3{0, 1, 1}}));
}

TEST(TriangleCull, TrianglesOfAMeshlet_AreLookedAtOneByOne) {
    auto cull = screen();
    cull.clip_from_object[2][3] = 1; // w = 1 + z
    std::vector<glm::vec3> corners(kFront.begin(), kFront.end());
    corners.emplace_back(0, -0.9F, -2); // behind the eye
    corners.emplace_back(3, 0.5F, 0);   // beside the picture, as these
    corners.emplace_back(3, -0.5F, 0);
    corners.emplace_back(4, 0, 0);
    const std::array<uint32_t, 12> words = {6, 5,        4,        3,        2,        1,
                                            0, 0x040506, 0x050406, 0x000102, 0x010002, 0x030406};
    std::vector<uint32_t> out = {7};
    appendVisibleTriangles(cull, {{.index_count = 15, .vertex_count = 7}, words}, corners, out);
    EXPECT_EQ(out, (std::vector<uint32_t>{7, 0, 1, 2, 0, 2, 3}));
}

// Whatever covers a pixel centre by exact arithmetic, snapped to 1/256 pixel or not, is kept.
TEST(TriangleCull, CoveringAPixelCentre_IsNeverRemoved) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-1.1F, 1.1F);
    std::uniform_real_distribution<float> size(0.001F, 0.1F);
    int covering = 0;
    for (int i = 0; i < 200'000; ++i) {
        const glm::vec3 at(place(random), place(random), 0);
        const float extent = size(random);
        std::array<glm::vec3, 3> t;
        for (auto& corner : t) {
            corner = at + glm::vec3(place(random), place(random), 0) * extent;
        }
        const auto side = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
            return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        };
        std::array<glm::dvec2, 3> px;
        for (size_t c = 0; c < 3; ++c) {
            px[c] = (glm::dvec2(t[c]) + 1.0) * 32.0;
        }
        bool covers = false;
        for (int y = std::max(0, static_cast<int>(px[0].y) - 8);
             y < std::min(64, static_cast<int>(px[0].y) + 9); ++y) {
            for (int x = std::max(0, static_cast<int>(px[0].x) - 8);
                 x < std::min(64, static_cast<int>(px[0].x) + 9); ++x) {
                const glm::dvec2 p(x + 0.5, y + 0.5);
                // y down: counter-clockwise as seen has negative sides.
                covers |= side(px[0], px[1], p) < 0 && side(px[1], px[2], p) < 0 &&
                          side(px[2], px[0], p) < 0;
            }
        }
        covering += covers ? 1 : 0;
        if (covers) {
            ASSERT_TRUE(kept(screen(), t));
        }
    }
    EXPECT_GT(covering, 1000);
}

} // namespace froxel::render
