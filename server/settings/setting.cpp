#include "settings/setting.h"

#include "core/text.h"

namespace froxel::settings {

std::string textOf(const Setting& setting, const SettingValue& value) {
    switch (setting.kind) {
    case SettingKind::kSwitch:
        return std::get<bool>(value) ? "true" : "false";
    case SettingKind::kWhole:
        return numberText(std::get<uint32_t>(value));
    case SettingKind::kReal: {
        const double number = std::get<double>(value);
        return setting.single ? numberText(static_cast<float>(number)) : numberText(number);
    }
    case SettingKind::kChoice:
        return std::string(setting.value_names[std::get<Choice>(value).index]);
    case SettingKind::kColor:
        break;
    }
    const auto& color = std::get<glm::dvec3>(value);
    const auto part = [&color](int axis) { return numberText(static_cast<float>(color[axis])); };
    return part(0) + "," + part(1) + "," + part(2);
}

std::string addressText(const Setting& setting, const SettingValue& value) {
    const bool* on = std::get_if<bool>(&value);
    return on != nullptr ? *on ? "1" : "0" : textOf(setting, value);
}

} // namespace froxel::settings
