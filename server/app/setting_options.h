// Options of what is drawn, for the subcommands that draw: of the table's settings, from their
// rows, and of the few that are by hand.
#pragma once

#include "app/command_builder.h"
#include "scene/looks.h"
#include "settings/setting.h"
#include "settings/settings.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace froxel::app {

// "--fog-density" of "fog_density"; "--no-animate" of a switch that is usually on.
[[nodiscard]] std::string optionName(const settings::Setting& setting,
                                     const settings::SettingValue& usual);

// The option of one setting. `set` is called with what was given.
void addSetting(CommandBuilder& command,
                const settings::Setting& setting,
                const settings::SettingValue& usual,
                const std::function<void(const settings::SettingValue&)>& set);

// Of a setting that is no switch, where words tell its default.
void addSettingValue(CommandBuilder& command,
                     const settings::Setting& setting,
                     const std::string& shown_default,
                     const std::function<void(const settings::SettingValue&)>& set);

// Of `target`, which has its default.
template <class Whole>
void addSetting(CommandBuilder& command, const settings::SettingOf<Whole>& row, Whole& target) {
    addSetting(command, row, row.get(target),
               [&row, &target](const settings::SettingValue& value) { row.set(target, value); });
}

// The rows whose option was there, by name.
using GivenSettings = std::set<std::string_view>;

// Empty: none was given, so it is the scene's usual one. Null: no look at all.
using ChosenLook = std::optional<const scene::Look*>;

// A named preset; each setting that is given goes before it.
void addLook(CommandBuilder& command, ChosenLook& look);

// All settings of the view's table, its grid and its lights; `light_set` becomes the file that
// placed ones were read from.
void addViewSettings(CommandBuilder& command,
                     settings::ViewSettings& settings,
                     GivenSettings& given,
                     std::filesystem::path& light_set);
// Of them the lights alone.
void addLights(CommandBuilder& command,
               settings::ViewSettings& settings,
               std::filesystem::path& light_set);

} // namespace froxel::app
