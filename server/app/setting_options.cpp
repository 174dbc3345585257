#include "app/setting_options.h"

#include "app/light_set_file.h"
#include "core/assert.h"
#include "core/text.h"
#include "settings/setting_rows.h"

#include <algorithm>
#include <array>
#include <vector>

namespace froxel::app {

namespace {

using settings::SettingKind;
using settings::SettingValue;

// What an option says that turns off what is usually on.
struct OffWords {
    std::string_view name;
    std::string_view help;
};
constexpr std::array kOffWords{
    OffWords{"animate", "Keeps the seeded lights where they are"},
    OffWords{"scene_lights", "Turns off the lights of the scene's file"},
    OffWords{"animation_playing", "Stops the scene's animation at its beginning"},
};

std::string_view offHelp(const settings::Setting& setting) {
    const auto* words = std::ranges::find(kOffWords, setting.name, &OffWords::name);
    FROXEL_ASSERT(words != kOffWords.end(), "a switch that is usually on has words for off");
    return words->help;
}

// Headings of --help, by how settings' names begin; the first that fits counts.
struct Heading {
    std::string_view prefix;
    std::string_view text;
};
constexpr std::array kHeadings{
    Heading{"light_loop", "Renderer"},
    Heading{"lighting", "Renderer"},
    Heading{"light", "Lights"},
    Heading{"seed", "Lights"},
    Heading{"animate", "Lights"},
    Heading{"ambient", "Lights"},
    Heading{"scene_light", "Lights"},
    Heading{"animation", "Animation"},
    Heading{"environment", "Environment and background"},
    Heading{"background", "Environment and background"},
    Heading{"exposure", "Exposure and colour"},
    Heading{"tone_map", "Exposure and colour"},
    Heading{"toon", "Toon renderers"},
    Heading{"outline", "Toon renderers"},
    Heading{"bloom", "Effects"},
    Heading{"antialiasing", "Effects"},
    Heading{"fog", "Effects"},
    Heading{"shadow", "Effects"},
    Heading{"debug", "Debug views"},
    Heading{"", "Renderer"},
};

std::string headingOf(const settings::Setting& setting) {
    const auto* heading = std::ranges::find_if(
        kHeadings, [&](const Heading& row) { return setting.name.starts_with(row.prefix); });
    return std::string(heading->text);
}

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
                  "Box in which the lights move: \"x,y,z;x,y,z\" in metres, smallest corner first");
    const auto parse = [&file](const std::string& text) {
        file = text;
        return readLightSet(file);
    };
    command.value("--light-set", "FILE", lights.placed, parse, "none",
                  "Placed lights, in a file that the page saves");
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
            std::string(given ? setting.words.help : offHelp(setting)));
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

void addLook(CommandBuilder& command, ChosenLook& look) {
    std::vector<std::string_view> names(scene::lookNames().begin(), scene::lookNames().end());
    names.emplace_back("none");
    const auto parse = [names](const std::string& text) { return parseName(text, names); };
    const auto set = [&look](size_t index) {
        look = index < scene::looks().size() ? &scene::looks()[index] : nullptr;
    };
    command.parsed("--look", "NAME", parse, set, "evening in the hall and Sponza, else none",
                   "Preset of lights, environment and renderer: " + describe(names));
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
        command.group(headingOf(row));
    }
    addGrid(command, settings.grid);
    command.group("Renderer");
    addLightPlaces(command, settings.lights, light_set);
    command.group("Lights");
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
