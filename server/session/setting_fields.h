// Settings in the protocol's messages, wherever the schema's option (setting) has put them. Pure;
// any thread.
#pragma once

#include "session/field_validator.h"
#include "session/settings.h"

#include <google/protobuf/message.h>

namespace froxel::session {

// Whether a command holds settings and nothing else.
[[nodiscard]] bool holdsSettingsAlone(const google::protobuf::Descriptor& command);

// What a command gives, each number in its range and each name known, or refused by `fields`.
// Absent fields give nothing; a command that needs one and has none is refused.
[[nodiscard]] SettingChanges decodeSettings(const google::protobuf::Message& command,
                                            FieldValidator& fields);

// Sets every field that holds a setting.
void fillSettings(google::protobuf::Message& out, const SessionState& state);

} // namespace froxel::session
