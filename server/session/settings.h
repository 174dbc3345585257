// Every setting of a session, found by its name, whichever part of the state it belongs to.
#pragma once

#include "session/delivery.h"
#include "settings/setting.h"
#include "settings/settings.h"

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace froxel::session {

struct SessionState;

class SessionSetting {
  public:
    template <class Whole>
    explicit SessionSetting(const settings::SettingOf<Whole>& row) : row_(&row) {}

    [[nodiscard]] const settings::Setting& facts() const;
    [[nodiscard]] settings::SettingValue valueIn(const SessionState& state) const;
    // The value is of the setting's kind and in its range.
    void set(SessionState& state, const settings::SettingValue& value) const;

  private:
    std::variant<const settings::SettingOf<settings::ViewSettings>*,
                 const settings::SettingOf<settings::Encoding>*,
                 const settings::SettingOf<DeliverySettings>*>
        row_;
};

// In the order of their tables: of the view, of encoding, of delivery.
[[nodiscard]] std::span<const SessionSetting> sessionSettings();
// Null: there is none of that name.
[[nodiscard]] const SessionSetting* findSetting(std::string_view name);

// "renderer=naive lights=5": those that are not as a struct has them, for the log.
[[nodiscard]] std::string unusualSettings(const SessionState& state);

struct SettingChange {
    const SessionSetting* setting = nullptr; // never null in a command
    settings::SettingValue value;
    bool operator==(const SettingChange&) const = default;
};
using SettingChanges = std::vector<SettingChange>;

// What is given for the setting of this name; null: nothing.
[[nodiscard]] const settings::SettingValue* givenIn(const SettingChanges& changes,
                                                    std::string_view name);

} // namespace froxel::session
