// What settings may be at.
#pragma once

#include "settings/setting.h"

#include <cmath>

namespace froxel::test {

// Whether a value is of the setting's kind and in its range.
inline bool accepts(const settings::Setting& setting, const settings::SettingValue& value) {
    switch (setting.kind) {
    case settings::SettingKind::kSwitch:
        return std::holds_alternative<bool>(value);
    case settings::SettingKind::kWhole:
        return setting.contains(std::get<uint32_t>(value));
    case settings::SettingKind::kReal:
        return setting.contains(std::get<double>(value));
    case settings::SettingKind::kChoice:
        return std::get<settings::Choice>(value).index < setting.names.size();
    case settings::SettingKind::kColor:
        break;
    }
    const auto& color = std::get<glm::dvec3>(value);
    return setting.contains(color.x) && setting.contains(color.y) && setting.contains(color.z);
}

// Another value that the setting may be at, which a float holds exactly.
inline settings::SettingValue otherValue(const settings::Setting& setting,
                                         const settings::SettingValue& now) {
    switch (setting.kind) {
    case settings::SettingKind::kSwitch:
        return !std::get<bool>(now);
    case settings::SettingKind::kWhole: {
        const uint32_t value = std::get<uint32_t>(now);
        return value < setting.max ? value + 1 : value - 1;
    }
    case settings::SettingKind::kChoice:
        return settings::Choice{(std::get<settings::Choice>(now).index + 1) % setting.names.size()};
    case settings::SettingKind::kReal: {
        const double span = setting.max - setting.min;
        const auto value = static_cast<float>(setting.min + 0.375 * span);
        return static_cast<double>(value) != std::get<double>(now)
                   ? static_cast<double>(value)
                   : static_cast<double>(static_cast<float>(setting.min + 0.75 * span));
    }
    case settings::SettingKind::kColor:
        break;
    }
    return glm::dvec3(setting.min, setting.max, 0.5 * (setting.min + setting.max));
}

} // namespace froxel::test
