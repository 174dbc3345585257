// Values for settings by their names.
#pragma once

#include "session/command.h"
#include "session/settings.h"
#include "support/setting_values.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <utility>

namespace froxel::test {

template <class Enum>
settings::SettingValue chosen(Enum value) {
    return settings::Choice{static_cast<size_t>(value)};
}

inline session::SettingChanges
changes(std::initializer_list<std::pair<std::string_view, settings::SettingValue>> values) {
    session::SettingChanges all;
    for (const auto& [name, value] : values) {
        all.push_back({session::findSetting(name), value});
        EXPECT_NE(all.back().setting, nullptr) << name;
    }
    return all;
}

inline session::SetSettings
settings(std::initializer_list<std::pair<std::string_view, settings::SettingValue>> values) {
    return {changes(values)};
}

// What a command gives for this setting; fails the test where it gives nothing.
template <class Value, class Command>
Value givenBy(const Command& command, std::string_view name) {
    const settings::SettingValue* value = session::givenIn(command.changes, name);
    if (value == nullptr) {
        ADD_FAILURE() << name << " is not given";
        return {};
    }
    if constexpr (std::is_enum_v<Value>) {
        return static_cast<Value>(std::get<settings::Choice>(*value).index);
    } else {
        return std::get<Value>(*value);
    }
}

} // namespace froxel::test
