// Commands that say how the lit picture looks: toon ramps and outlines, bloom, antialiasing,
// transparency, fog, shadows.
#pragma once

#include "froxel/v1/client.pb.h"
#include "session/command.h"
#include "session/field_validator.h"

namespace froxel::session {

[[nodiscard]] SetToon decodeToon(const v1::SetToon& toon, FieldValidator& fields);
[[nodiscard]] SetPost decodePost(const v1::SetPost& set, FieldValidator& fields);
[[nodiscard]] SetTransparency decodeTransparency(const v1::SetTransparency& set,
                                                 FieldValidator& fields);
[[nodiscard]] SetFog decodeFog(const v1::Fog& fog, FieldValidator& fields);
[[nodiscard]] SetShadows decodeShadows(const v1::SetShadows& set, FieldValidator& fields);

} // namespace froxel::session
