// docs/guide/settings.md is the table of settings, for readers. FROXEL_WRITE_DOCS=1 writes it anew.
#include "app/setting_options.h"
#include "core/text.h"
#include "session/session_state.h"
#include "session/settings.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace froxel::app {
namespace {

constexpr const char* kIntroduction = R"(# Settings

For people who look for one number, switch or name among all. This page is made from the server's own table: what it
says is what the options, the page, the protocol and the reports take. The option of a setting has its
name with dashes: `--fog-density`. A switch that is usually on has an option that turns it off: `--no-animate`.

| setting | of | usual | what it does | costs |
|---|---|---|---|---|
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
        text += "| `" + std::string(facts.name) + "` | " + valuesOf(facts) + " | " + shown + " | " +
                std::string(facts.words.help) + " | " + std::string(facts.words.cost) + " |\n";
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

} // namespace
} // namespace froxel::app
