// What settings may be at.
#pragma once

#include "view/setting.h"

#include <cmath>

namespace froxel::test {

// Whether a value is of the setting's kind and in its range.
inline bool accepts(const view::Setting& setting, const view::SettingValue& value) {
    switch (setting.kind) {
    case view::SettingKind::kSwitch:
        return std::holds_alternative<bool>(value);
    case view::SettingKind::kWhole:
        return setting.contains(std::get<uint32_t>(value));
    case view::SettingKind::kReal:
        return setting.contains(std::get<double>(value));
    case view::SettingKind::kChoice:
        return std::get<view::Choice>(value).index < setting.names.size();
    case view::SettingKind::kColor:
        break;
    }
    const auto& color = std::get<glm::dvec3>(value);
    return setting.contains(color.x) && setting.contains(color.y) && setting.contains(color.z);
}

// Another value that the setting may be at, which a float holds exactly.
inline view::SettingValue otherValue(const view::Setting& setting, const view::SettingValue& now) {
    switch (setting.kind) {
    case view::SettingKind::kSwitch:
        return !std::get<bool>(now);
    case view::SettingKind::kWhole: {
        const uint32_t value = std::get<uint32_t>(now);
        return value < setting.max ? value + 1 : value - 1;
    }
    case view::SettingKind::kChoice:
        return view::Choice{(std::get<view::Choice>(now).index + 1) % setting.names.size()};
    case view::SettingKind::kReal: {
        const double span = setting.max - setting.min;
        const auto value = static_cast<float>(setting.min + 0.375 * span);
        return static_cast<double>(value) != std::get<double>(now)
                   ? static_cast<double>(value)
                   : static_cast<double>(static_cast<float>(setting.min + 0.75 * span));
    }
    case view::SettingKind::kColor:
        break;
    }
    return glm::dvec3(setting.min, setting.max, 0.5 * (setting.min + setting.max));
}

} // namespace froxel::test
