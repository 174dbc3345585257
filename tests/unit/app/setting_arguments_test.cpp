// Every row of the table as an option and in command lines that repeat a picture.
#include "app/light_set_file.h"
#include "app/setting_options.h"
#include "settings/setting_rows.h"
#include "support/settings.h"
#include "unit/app/parsed_options.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace froxel::app {
namespace {

TEST(SettingArguments, EachSettingAlone_ParsesBack) {
    for (const auto& row : settings::kSettingRows) {
        RenderOptions options;
        options.timings = "t.json";
        row.set(options.settings, test::otherValue(row, row.get(options.settings)));
        EXPECT_NE(options.settings, settings::ViewSettings{}) << row.name;
        EXPECT_EQ(parsedBack(options).settings, options.settings) << row.name;
    }
}

TEST(SettingArguments, AllTogether_WithWhatIsByHand_ParseBack) {
    RenderOptions options;
    auto& settings = options.settings;
    for (const auto& row : settings::kSettingRows) {
        row.set(settings, test::otherValue(row, row.get(settings)));
    }
    settings.grid.automatic = false;
    settings.grid.size = {3, 4, 5};
    settings.size = {64, 36};
    settings.lights.box = BoundsD3{{-1, -2, -3}, {1, 2, 3}};
    const auto file = std::filesystem::path(testing::TempDir()) / "setting_arguments_lights.json";
    std::ofstream(file) << R"({"lights":[{"id":1,"position":{"x":2}}]})";
    settings.lights.placed = readLightSet(file).value();
    options.light_set = file;
    options.lens_shift = glm::dvec2(0.1, -0.25);
    options.timings = "t.json";
    const RenderOptions parsed = parsedBack(options);
    EXPECT_EQ(parsed.settings, settings);
    EXPECT_EQ(parsed.lens_shift, options.lens_shift);
    EXPECT_EQ(parsed.camera, CameraChoice(DefaultCamera{}));
}

TEST(SettingArguments, Serve_TakesThemForTheFirstView) {
    for (const auto& row : settings::kSettingRows) {
        const settings::ViewSettings usual;
        const settings::SettingValue value = test::otherValue(row, row.get(usual));
        const std::string option = optionName(row, row.get(usual));
        const std::string text = settings::textOf(row, value);
        std::vector<const char*> arguments{"serve", option.c_str()};
        if (row.kind != settings::SettingKind::kSwitch) {
            arguments.push_back(text.c_str());
        }
        const auto parsed = parse(arguments);
        EXPECT_EQ(row.get(std::get<ServeOptions>(parsed.command).first_view), value) << option;
    }
}

TEST(SettingArguments, OutOfRangeOrUnknown_IsRefusedByOptionValueAndWhatWouldBeRight) {
    for (const auto& row : settings::kSettingRows) {
        const std::string option = optionName(row, row.get(settings::ViewSettings{}));
        const bool color = row.kind == settings::SettingKind::kColor;
        const std::string bad = color ? "0,2,0" : "-100000000";
        if (row.kind != settings::SettingKind::kSwitch) {
            const std::string why =
                refusal({"render", "--out", "a.png", option.c_str(), bad.c_str()});
            EXPECT_THAT(why, testing::HasSubstr(option));
            EXPECT_THAT(why, testing::HasSubstr("'" + bad + "'"));
        }
    }
}

TEST(SettingArguments, Help_HasOptionsWithDefaultsRangesAndUnits) {
    const auto text = std::get<PrintText>(parse({"render", "--help"}).command).text;
    for (const auto& row : settings::kSettingRows) {
        EXPECT_THAT(text, testing::HasSubstr(optionName(row, row.get(settings::ViewSettings{}))));
    }
    EXPECT_THAT(text, testing::HasSubstr("--no-animate"));
    EXPECT_THAT(text, testing::HasSubstr("[0.015]"));
}

} // namespace
} // namespace froxel::app
