#include "session/offered_looks.h"

#include "scene/looks.h"
#include "settings/setting_rows.h"

#include <algorithm>
#include <iterator>

namespace froxel::session {

namespace {

using settings::ViewSettings;

std::string addressText(const settings::Setting& setting, const settings::SettingValue& value) {
    const bool* on = std::get_if<bool>(&value);
    return on != nullptr ? *on ? "1" : "0" : textOf(setting, value);
}

} // namespace

std::vector<OfferedLook> offerLooks(const ViewSettings& usual, bool software) {
    std::vector<ViewSettings> all(scene::looks().size(), usual);
    std::transform(scene::looks().begin(), scene::looks().end(), all.begin(), all.begin(),
                   [&](const scene::Look& look, ViewSettings settings) {
                       look.apply(settings, software);
                       return settings;
                   });
    std::vector<OfferedLook> offered;
    std::transform(scene::looks().begin(), scene::looks().end(), std::back_inserter(offered),
                   [](const scene::Look& look) {
                       return OfferedLook{std::string(look.name),
                                          std::string(look.label),
                                          std::string(look.help),
                                          {}};
                   });
    for (const auto& row : settings::kSettingRows) {
        const auto changes = [&](const ViewSettings& settings) {
            return row.get(settings) != row.get(usual);
        };
        if (std::none_of(all.begin(), all.end(), changes)) {
            continue;
        }
        for (size_t i = 0; i < all.size(); ++i) {
            std::string& address = offered[i].address;
            address += address.empty() ? "" : "&";
            address += std::string(row.name) + "=" + addressText(row, row.get(all[i]));
        }
    }
    return offered;
}

} // namespace froxel::session
