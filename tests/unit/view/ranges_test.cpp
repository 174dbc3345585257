#include "view/ranges.h"
#include "view/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace froxel::view {
namespace {

TEST(Range, EdgesAreInside_NanIsNot) {
    EXPECT_TRUE(kFovRange.contains(kFovRange.min));
    EXPECT_TRUE(kFovRange.contains(kFovRange.max));
    EXPECT_FALSE(kFovRange.contains(std::nextafter(kFovRange.max, 1e9)));
    EXPECT_FALSE(kFovRange.contains(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(kFovRange.contains(std::numeric_limits<double>::infinity()));
}

TEST(CommandRanges, FieldNames_AreDistinctAndOrdered) {
    std::set<std::string_view> names;
    const auto check = [&](const auto& range) {
        EXPECT_TRUE(names.insert(range.field).second) << range.field;
        EXPECT_LT(range.min, range.max) << range.field;
    };
    std::apply([&](const auto&... range) { (check(range), ...); }, kCommandRanges);
}

TEST(CommandRanges, Defaults_AreAccepted) {
    const ViewSettings settings;
    EXPECT_TRUE(kWidthRange.contains(settings.size.width_px));
    EXPECT_TRUE(kHeightRange.contains(settings.size.height_px));
    EXPECT_TRUE(kLightCountRange.contains(settings.lights.count));
    EXPECT_TRUE(kLightRadiusRange.contains(settings.lights.radius_m));
    EXPECT_TRUE(kGridXRange.contains(settings.grid.size.x));
    EXPECT_TRUE(kGridZRange.contains(settings.grid.size.z));
    EXPECT_TRUE(kExposureRange.contains(settings.exposure));
    EXPECT_TRUE(kFovRange.contains(glm::degrees(settings.camera.yfov_rad)));
    EXPECT_TRUE(kQualityRange.contains(Encoding{}.quality));
    for (uint32_t i = 1; i < settings.toon_fragment.count; ++i) {
        EXPECT_GT(settings.toon_fragment.points[i].x, settings.toon_fragment.points[i - 1].x);
    }
}

} // namespace
} // namespace froxel::view
