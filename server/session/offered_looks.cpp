#include "session/offered_looks.h"

#include "scene/looks.h"
#include "settings/setting_rows.h"

#include <algorithm>
#include <utility>

namespace froxel::session {

namespace {

using settings::ViewSettings;

// Another one that the setting may be at.
settings::SettingValue otherThan(const settings::Setting& setting,
                                 const settings::SettingValue& value) {
    switch (setting.kind) {
    case settings::SettingKind::kSwitch:
        return !std::get<bool>(value);
    case settings::SettingKind::kWhole:
        return static_cast<uint32_t>(std::get<uint32_t>(value) == setting.min ? setting.max
                                                                              : setting.min);
    case settings::SettingKind::kReal:
        return std::get<double>(value) == setting.min ? setting.max : setting.min;
    case settings::SettingKind::kChoice:
        return settings::Choice{(std::get<settings::Choice>(value).index + 1) %
                                setting.names.size()};
    case settings::SettingKind::kColor:
        break;
    }
    const glm::dvec3 least(setting.min);
    return std::get<glm::dvec3>(value) == least ? glm::dvec3(setting.max) : least;
}

ViewSettings with(const scene::Look& look, ViewSettings settings, bool software) {
    look.apply(settings, software);
    return settings;
}

bool anyChanges(const settings::SettingOf<ViewSettings>& row,
                const ViewSettings& before,
                bool software) {
    return std::any_of(scene::looks().begin(), scene::looks().end(), [&](const scene::Look& look) {
        return row.get(with(look, before, software)) != row.get(before);
    });
}

// Whether a look sets it, though it may be at that already.
bool anySets(const settings::SettingOf<ViewSettings>& row,
             const ViewSettings& usual,
             bool software) {
    ViewSettings other = usual;
    row.set(other, otherThan(row, row.get(usual)));
    return anyChanges(row, usual, software) || anyChanges(row, other, software);
}

} // namespace

std::vector<OfferedLook> offerLooks(const ViewSettings& usual, bool software) {
    std::vector<const settings::SettingOf<ViewSettings>*> set;
    for (const auto& row : settings::kSettingRows) {
        if (anySets(row, usual, software)) {
            set.push_back(&row);
        }
    }
    std::vector<OfferedLook> offered;
    for (const scene::Look& look : scene::looks()) {
        const ViewSettings settings = with(look, usual, software);
        std::string address;
        for (const auto* row : set) {
            address += address.empty() ? "" : "&";
            address += std::string(row->name) + "=" + addressText(*row, row->get(settings));
        }
        offered.push_back({std::string(look.name), std::string(look.label), std::string(look.help),
                           std::move(address)});
    }
    return offered;
}

} // namespace froxel::session
