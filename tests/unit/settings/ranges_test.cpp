#include "settings/ranges.h"
#include "settings/setting_rows.h"
#include "support/setting_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace froxel::settings {
namespace {

TEST(Range, EdgesAreInside_NanIsNot) {
    EXPECT_TRUE(kFovRange.contains(kFovRange.min));
    EXPECT_TRUE(kFovRange.contains(kFovRange.max));
    EXPECT_FALSE(kFovRange.contains(std::nextafter(kFovRange.max, 1e9)));
    EXPECT_FALSE(kFovRange.contains(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(kFovRange.contains(std::numeric_limits<double>::infinity()));
}

template <class Rows, class Check>
void forEach(const Rows& rows, const Check& check) {
    for (const auto& row : rows) {
        check(row);
    }
}

TEST(Settings, Names_AreDistinct_FromThoseOfOtherRangesToo) {
    std::set<std::string_view> names;
    const auto check = [&](const auto& range) {
        EXPECT_TRUE(names.insert(range.field).second) << range.field;
        EXPECT_LT(range.min, range.max) << range.field;
    };
    std::apply([&](const auto&... range) { (check(range), ...); }, kOtherRanges);
    const auto distinct = [&](const Setting& row) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
    };
    forEach(kSettingRows, distinct);
    forEach(kEncodingRows, distinct);
}

TEST(Settings, ReportPaths_AreDistinctAndNoneIsPartOfAnother) {
    std::set<std::string> paths;
    forEach(kSettingRows, [&](const Setting& row) {
        EXPECT_TRUE(paths.insert(std::string(row.path)).second) << row.path;
    });
    for (const std::string& path : paths) {
        for (size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
            EXPECT_FALSE(paths.contains(path.substr(0, dot))) << path;
        }
    }
}

TEST(Settings, Defaults_AreAccepted) {
    const ViewSettings settings;
    forEach(kSettingRows, [&](const auto& row) {
        EXPECT_TRUE(test::accepts(row, row.get(settings))) << row.name;
    });
    EXPECT_TRUE(kWidthRange.contains(settings.size.width_px));
    EXPECT_TRUE(kHeightRange.contains(settings.size.height_px));
    EXPECT_TRUE(kGridXRange.contains(settings.grid.size.x));
    EXPECT_TRUE(kGridZRange.contains(settings.grid.size.z));
    EXPECT_TRUE(kFovRange.contains(glm::degrees(settings.camera.yfov_rad)));
    for (uint32_t i = 1; i < settings.toon_fragment.count; ++i) {
        EXPECT_GT(settings.toon_fragment.points[i].x, settings.toon_fragment.points[i - 1].x);
    }
}

TEST(Settings, Text_IsTheShortestThatReadsBackInTheMembersOwnType) {
    const auto text = [](std::string_view name, const ViewSettings& settings) {
        for (const auto& row : kSettingRows) {
            if (row.name == name) {
                return textOf(row, row.get(settings));
            }
        }
        return std::string();
    };
    ViewSettings settings;
    settings.fog.albedo = {1, 0.1F, 0.5F};
    EXPECT_EQ(text("bloom_radius", settings), "0.015"); // a float
    EXPECT_EQ(text("fog_base_height", settings), "0");
    EXPECT_EQ(text("fog_albedo", settings), "1,0.1,0.5");
    EXPECT_EQ(text("lights", settings), "1000");
    EXPECT_EQ(text("bloom", settings), "none");
    EXPECT_EQ(text("animate", settings), "true");
}

// A still may be of a codec that nobody chooses for the stream.
TEST(Settings, TextOfEveryCodec_IsItsName) {
    const auto row = std::ranges::find(kEncodingRows, "codec", &Setting::name);
    ASSERT_NE(row, kEncodingRows.end());
    EXPECT_LT(row->names.size(), kCodecRows.size());
    for (const CodecRow& codec : kCodecRows) {
        EXPECT_EQ(textOf(*row, row->get({.codec = codec.codec})), codec.name);
    }
}

} // namespace
} // namespace froxel::settings
