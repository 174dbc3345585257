#include "session/settings.h"

#include "session/delivery_rows.h"
#include "session/session_state.h"
#include "settings/setting_cover.h"
#include "settings/setting_rows.h"

#include <algorithm>

namespace froxel::session {
namespace {

static_assert(settings::covers<DeliverySettings>(kDeliveryRows, 0));

// Which part of a state a table's rows are read and set in.
template <class State>
auto& partOf(State& state, const settings::ViewSettings* /*whole*/) {
    return state.settings;
}
template <class State>
auto& partOf(State& state, const settings::Encoding* /*whole*/) {
    return state.encoding;
}
template <class State>
auto& partOf(State& state, const DeliverySettings* /*whole*/) {
    return state.delivery;
}

template <class Whole, class State>
auto& partFor(const settings::SettingOf<Whole>& /*row*/, State& state) {
    return partOf(state, static_cast<const Whole*>(nullptr));
}

std::vector<SessionSetting> allRows() {
    std::vector<SessionSetting> all;
    for (const auto& row : settings::kSettingRows) {
        all.emplace_back(row);
    }
    for (const auto& row : settings::kEncodingRows) {
        all.emplace_back(row);
    }
    for (const auto& row : kDeliveryRows) {
        all.emplace_back(row);
    }
    return all;
}

} // namespace

const settings::Setting& SessionSetting::facts() const {
    return std::visit([](const auto* row) -> const settings::Setting& { return *row; }, row_);
}

settings::SettingValue SessionSetting::valueIn(const SessionState& state) const {
    return std::visit([&state](const auto* row) { return row->get(partFor(*row, state)); }, row_);
}

void SessionSetting::set(SessionState& state, const settings::SettingValue& value) const {
    std::visit([&](const auto* row) { row->set(partFor(*row, state), value); }, row_);
}

std::span<const SessionSetting> sessionSettings() {
    static const std::vector<SessionSetting> all = allRows();
    return all;
}

const SessionSetting* findSetting(std::string_view name) {
    const auto all = sessionSettings();
    const auto found = std::find_if(all.begin(), all.end(), [name](const SessionSetting& setting) {
        return setting.facts().name == name;
    });
    return found == all.end() ? nullptr : &*found;
}

std::string unusualSettings(const SessionState& state) {
    SessionState usual = state;
    usual.settings = {};
    usual.encoding = {};
    usual.delivery = {};
    std::string words;
    for (const SessionSetting& setting : sessionSettings()) {
        const settings::SettingValue value = setting.valueIn(state);
        if (value != setting.valueIn(usual)) {
            words += (words.empty() ? "" : " ") + std::string(setting.facts().name) + "=" +
                     textOf(setting.facts(), value);
        }
    }
    return words;
}

const settings::SettingValue* givenIn(const SettingChanges& changes, std::string_view name) {
    const auto found = std::find_if(changes.begin(), changes.end(), [name](const auto& change) {
        return change.setting->facts().name == name;
    });
    return found == changes.end() ? nullptr : &found->value;
}

} // namespace froxel::session
