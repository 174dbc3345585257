#include "app/setting_options.h"

#include "app/light_set_file.h"
#include "core/text.h"
#include "settings/setting_rows.h"

#include <algorithm>

namespace froxel::app {

namespace {

using settings::SettingKind;
using settings::SettingValue;

bool usuallyOn(const SettingValue& usual) {
    const bool* on = std::get_if<bool>(&usual);
    return on != nullptr && *on;
}

std::string dashed(const settings::Setting& setting) {
    std::string name(setting.name);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

std::string helpOf(const settings::Setting& setting) {
    std::string help(setting.words.help);
    if (setting.kind == SettingKind::kChoice) {
        return help + ": " + describe(setting.names);
    }
    help += "; " + numberText(setting.min) + " to " + numberText(setting.max);
    return setting.words.unit.empty() ? help : help + " " + std::string(setting.words.unit);
}

void addGrid(CommandBuilder& command, settings::Grid& target) {
    const auto parse = [&target](const std::string& text) { return parseGridChoice(text, target); };
    command.value("--grid", "auto|XxYxZ", target, parse, "auto",
                  fmt::format("Clusters across, down and deep, up to {}x{}x{}",
                              settings::kGridXRange.max, settings::kGridYRange.max,
                              settings::kGridZRange.max));
}

void addLightPlaces(CommandBuilder& command,
                    settings::Lights& lights,
                    std::filesystem::path& file) {
    command.value("--light-box", "BOX", lights.box, parseBox, "the scene's bounds",
                  "Where they move: \"x,y,z;x,y,z\" in metres, least corner first");
    const auto parse = [&file](const std::string& text) {
        file = text;
        return readLightSet(file);
    };
    command.value("--light-set", "FILE", lights.placed, parse, "none",
                  "Lights with places of their own, as the page saves them");
}

} // namespace

std::string optionName(const settings::Setting& setting, const SettingValue& usual) {
    return (usuallyOn(usual) ? "--no-" : "--") + dashed(setting);
}

void addSetting(CommandBuilder& command,
                const settings::Setting& setting,
                const SettingValue& usual,
                const std::function<void(const SettingValue&)>& set) {
    if (setting.kind == SettingKind::kSwitch) {
        const bool given = !usuallyOn(usual);
        command.cli().add_flag_callback(
            optionName(setting, usual), [set, given] { set(given); },
            (given ? "" : "Turns this off: ") + std::string(setting.words.help));
        return;
    }
    addSettingValue(command, setting, textOf(setting, usual), set);
}

void addSettingValue(CommandBuilder& command,
                     const settings::Setting& setting,
                     const std::string& shown_default,
                     const std::function<void(const SettingValue&)>& set) {
    const auto parse = [&setting](const std::string& text) { return parseSetting(setting, text); };
    const char* type = setting.kind == SettingKind::kChoice  ? "NAME"
                       : setting.kind == SettingKind::kColor ? "R,G,B"
                                                             : "N";
    command.parsed("--" + dashed(setting), type, parse, set, shown_default, helpOf(setting));
}

void addLook(CommandBuilder& command, const scene::Look*& look, const std::string& shown_default) {
    const auto parse = [](const std::string& text) { return parseName(text, scene::lookNames()); };
    command.parsed(
        "--look", "NAME", parse, [&look](size_t index) { look = &scene::looks()[index]; },
        shown_default,
        "Preset of lights, environment and renderer: " + describe(scene::lookNames()));
}

void addViewSettings(CommandBuilder& command,
                     settings::ViewSettings& settings,
                     GivenSettings& given,
                     std::filesystem::path& light_set) {
    for (const auto& row : settings::kSettingRows) {
        addSetting(command, row, row.get(settings),
                   [&row, &settings, &given](const SettingValue& value) {
                       row.set(settings, value);
                       given.insert(row.name);
                   });
    }
    addGrid(command, settings.grid);
    addLightPlaces(command, settings.lights, light_set);
}

void addLights(CommandBuilder& command,
               settings::ViewSettings& settings,
               std::filesystem::path& light_set) {
    for (const auto& row : settings::kSettingRows) {
        if (row.member_of == settings::membersOf<settings::Lights>()) {
            addSetting(command, row, settings);
        }
    }
    addLightPlaces(command, settings.lights, light_set);
}

} // namespace froxel::app
