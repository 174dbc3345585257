#include "core/math.h"

#include <gtest/gtest.h>

namespace froxel {
namespace {

TEST(Bounds, Fresh_IsEmptyWithoutSize) {
    const BoundsD3 bounds;
    EXPECT_TRUE(bounds.empty());
    EXPECT_EQ(bounds.size(), glm::dvec3(0));
}

TEST(Bounds, Points_GrowIt) {
    BoundsD3 bounds;
    bounds.add(glm::dvec3(1, 2, 3));
    EXPECT_FALSE(bounds.empty());
    EXPECT_EQ(bounds.size(), glm::dvec3(0));
    bounds.add(glm::dvec3(-1, 4, 3));
    EXPECT_EQ(bounds.min, glm::dvec3(-1, 2, 3));
    EXPECT_EQ(bounds.max, glm::dvec3(1, 4, 3));
    EXPECT_EQ(bounds.center(), glm::dvec3(0, 3, 3));
}

TEST(Bounds, AddingAnEmptyOne_ChangesNothing) {
    BoundsD3 bounds;
    bounds.add(glm::dvec3(1, 2, 3));
    const BoundsD3 before = bounds;
    bounds.add(BoundsD3{});
    EXPECT_EQ(bounds, before);
}

} // namespace
} // namespace froxel
