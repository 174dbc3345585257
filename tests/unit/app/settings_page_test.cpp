// docs/guide/settings.md is the table of settings, for readers. FROXEL_WRITE_DOCS=1 writes it anew.
#include "app/setting_options.h"
#include "core/text.h"
#include "session/session_state.h"
#include "session/settings.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

namespace froxel::app {
namespace {

constexpr const char* kIntroduction = R"(# Settings

For people who look up one setting. A test generates this page from the server's own table, so it matches the options,
the page, the protocol and the reports. The option of a setting has its name with dashes, such as `--fog-density`. A
switch that is on by default has an option that turns it off, such as `--no-animate`.

| setting | label | values | default | meaning | cost |
|---|---|---|---|---|---|
)";

std::string valuesOf(const settings::Setting& setting) {
    switch (setting.kind) {
    case settings::SettingKind::kSwitch:
        return "on or off";
    case settings::SettingKind::kChoice: {
        std::string names;
        for (const std::string_view name : setting.names) {
            names += (names.empty() ? "`" : ", `") + std::string(name) + "`";
        }
        return names;
    }
    case settings::SettingKind::kWhole:
    case settings::SettingKind::kReal:
    case settings::SettingKind::kColor:
        break;
    }
    std::string range = numberText(setting.min) + " to " + numberText(setting.max);
    if (setting.kind == settings::SettingKind::kColor) {
        range = "red, green, blue: " + range;
    }
    return setting.words.unit.empty() ? range : range + " " + std::string(setting.words.unit);
}

std::string page() {
    std::string text = kIntroduction;
    const session::SessionState usual = session::initialState({}, {});
    for (const session::SessionSetting& setting : session::sessionSettings()) {
        const settings::Setting& facts = setting.facts();
        const settings::SettingValue value = setting.valueIn(usual);
        const bool* on = std::get_if<bool>(&value);
        const std::string shown = on == nullptr ? "`" + textOf(facts, value) + "`"
                                  : *on         ? "on"
                                                : "off";
        text += "| `" + std::string(facts.name) + "` | " + std::string(facts.words.label) + " | " +
                valuesOf(facts) + " | " + shown + " | " + std::string(facts.words.help) + " | " +
                std::string(facts.words.cost) + " |\n";
    }
    return text;
}

TEST(SettingsPage, IsTheTable) {
    const auto path = test::repositoryPath("docs/guide/settings.md");
    if (std::getenv("FROXEL_WRITE_DOCS") != nullptr) {
        std::ofstream(path) << page();
    }
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(text, page()) << "FROXEL_WRITE_DOCS=1 writes it anew";
}

// Beginnings of what only says something beside its neighbours in the table.
constexpr std::array kLeaning = {
    std::string_view("That"),  std::string_view("This"),    std::string_view("These"),
    std::string_view("Those"), std::string_view("It"),      std::string_view("Its"),
    std::string_view("They"),  std::string_view("Their"),   std::string_view("Of"),
    std::string_view("How"),   std::string_view("Whether"), std::string_view("Where"),
    std::string_view("What"),  std::string_view("When"),    std::string_view("Which"),
    std::string_view("Such"),  std::string_view("Also"),    std::string_view("Likewise")};

TEST(SettingWords, LabelsAndHelps_StandAlone) {
    std::set<std::string_view> labels;
    for (const session::SessionSetting& setting : session::sessionSettings()) {
        const settings::Setting& facts = setting.facts();
        const auto& [label, help, unit, cost] = facts.words;
        EXPECT_TRUE(labels.insert(label).second) << facts.name << ": another has its label";
        EXPECT_GE(label.size(), 4U) << facts.name;
        EXPECT_LE(label.size(), 26U) << facts.name << ": does not fit beside its control";
        EXPECT_EQ(label.find('_'), std::string_view::npos) << facts.name;
        for (const std::string_view text : {label, help}) {
            ASSERT_FALSE(text.empty()) << facts.name;
            EXPECT_TRUE(std::isupper(static_cast<unsigned char>(text.front()))) << text;
            EXPECT_FALSE(text.ends_with(".")) << text;
            const std::string_view first = text.substr(0, text.find_first_of(" ,:;'"));
            EXPECT_EQ(std::find(kLeaning.begin(), kLeaning.end(), first), kLeaning.end()) << text;
        }
        EXPECT_GE(std::count(help.begin(), help.end(), ' '), 2) << help;
        EXPECT_NE(label, help) << facts.name;
    }
}

} // namespace
} // namespace froxel::app
