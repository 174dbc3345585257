#include "bench/budget.h"
#include "bench/presets.h"
#include "settings/ranges.h"
#include "settings/setting_rows.h"
#include "support/setting_values.h"
#include "unit/bench/every_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace froxel::bench {
namespace {

TEST(Presets, Full_AreAllThatSuitEveryScene) {
    const auto full = fullPresetNames();
    EXPECT_EQ(full.size() + 3, presetNames().size());
    EXPECT_EQ(std::ranges::count(full, "smoke"), 0);
    EXPECT_EQ(std::ranges::count(full, "material_variants"), 0);
    EXPECT_EQ(std::ranges::count(full, "geometry_error"), 0);
    EXPECT_EQ(presetNames().back(), "smoke");
}

TEST(Presets, EverySweep_IsNamedByItsPresetAndHasRows) {
    for (const auto name : presetNames()) {
        const auto sweep = makeSweep(name, base());
        EXPECT_EQ(sweep.name, name);
        EXPECT_GE(sweep.rows.size(), 3U) << name;
        EXPECT_FALSE(sweep.title.empty()) << name;
        EXPECT_FALSE(sweep.variable.empty()) << name;
    }
}

TEST(Presets, MaterialVariants_AreRowsBesideTheSurfacesOwn) {
    Base with = base();
    with.material_variants = {"red", ""};
    const auto sweep = makeSweep("material_variants", with);
    ASSERT_GE(sweep.rows.size(), 6U);
    EXPECT_EQ(sweep.rows[0].label, "none");
    EXPECT_EQ(sweep.rows[1].label, "red");
    EXPECT_EQ(sweep.rows[2].settings.material_variant, 2U);
    EXPECT_EQ(sweep.rows[2].value, 2);
}

TEST(Presets, EveryRow_IsInRange) {
    for (const auto& row : everyRow()) {
        const auto& s = row.settings;
        EXPECT_TRUE(settings::kWidthRange.contains(s.size.width_px)) << row.label;
        EXPECT_TRUE(settings::kHeightRange.contains(s.size.height_px)) << row.label;
        for (const auto& setting : settings::kSettingRows) {
            EXPECT_TRUE(test::accepts(setting, setting.get(s))) << setting.name << row.label;
        }
        EXPECT_TRUE(settings::kGridXRange.contains(s.grid.size.x)) << row.label;
        EXPECT_TRUE(settings::kGridYRange.contains(s.grid.size.y)) << row.label;
        EXPECT_TRUE(settings::kGridZRange.contains(s.grid.size.z)) << row.label;
        EXPECT_LT(row.timedView(), base().views.size());
        if (row.stream) {
            EXPECT_TRUE(settings::kQualityRange.contains(row.stream->quality)) << row.label;
        }
    }
}

TEST(Presets, RowsOfASweep_AreDistinctAndASeriesHasOneRowAnX) {
    for (const auto& sweep : everySweep()) {
        std::set<std::pair<std::string, std::string>> names;
        std::set<std::pair<std::string, double>> places;
        for (const auto& row : sweep.rows) {
            EXPECT_TRUE(names.emplace(row.series, row.label).second)
                << sweep.name << " " << row.series << " " << row.label;
            // Grids of different shapes may have as many clusters.
            EXPECT_TRUE(places.emplace(row.series, row.value).second || sweep.name == "grid")
                << sweep.name << " " << row.series << " " << row.label;
        }
    }
}

TEST(Presets, SeriesOfPredictableWork_AreInAscendingOrder) {
    for (const auto name : {"light_count", "resolution", "resolution_scale", "memory"}) {
        std::map<std::string, double> work;
        for (const auto& row : makeSweep(name, base()).rows) {
            const double now = workOf(row.settings);
            EXPECT_GE(now, work[row.series]) << name << " " << row.label;
            work[row.series] = now;
        }
    }
}

// As serve draws them, and each form once.
TEST(Presets, Form_HasEveryFormOfAPicture) {
    std::set<PictureForm> forms;
    for (const auto& row : makeSweep("form", base()).rows) {
        EXPECT_TRUE(row.keep_surfaces) << row.label;
        forms.insert(row.form ? settings::rowOf(row.form->codec).device_form
                              : PictureForm::kPixels);
    }
    EXPECT_EQ(forms.size(), 3U);
}

TEST(Presets, LightCount_GoesToAMillionForEveryWay) {
    std::map<std::string, uint32_t> most;
    for (const auto& row : makeSweep("light_count", base()).rows) {
        most[row.series] = std::max(most[row.series], row.settings.lights.count);
    }
    EXPECT_EQ(most.size(), 5U);
    for (const auto& [series, count] : most) {
        EXPECT_EQ(count, 1'000'000U) << series;
    }
}

TEST(Presets, Renderer_HasAllFiveInBothStages) {
    std::set<std::pair<settings::Renderer, settings::LightingStage>> ways;
    for (const auto& row : makeSweep("renderer", base()).rows) {
        ways.emplace(row.settings.renderer, row.settings.lighting);
    }
    EXPECT_EQ(ways.size(), 2 * settings::kRendererNames.size());
}

TEST(Presets, ResolutionScale_IsScaledToTheBase) {
    for (const auto& row : makeSweep("resolution_scale", base()).rows) {
        EXPECT_EQ(row.scaled_to, settings::Size{});
        EXPECT_EQ(row.settings.size.width_px, row.value * 1280) << row.label;
    }
}

} // namespace
} // namespace froxel::bench
