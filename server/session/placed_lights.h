// Placed lights between the protocol and the view: the change that a command asks for, a set from a
// file, and what a viewer is to be told. Pure; any thread.
#pragma once

#include "froxel/v1/common.pb.h"
#include "session/command.h"
#include "session/field_validator.h"

#include <string>
#include <string_view>

namespace froxel::session {

[[nodiscard]] SetPlacedLights decodePlacedLights(const v1::PlacedLights& set,
                                                 FieldValidator& fields);

// `lights` after the change. Refused, kOutOfRange: an id to be removed that is not there, a new
// light without a position, a cone inside out, two that stand for the same light, more than
// settings::kPlacedCountRange.
[[nodiscard]] CommandResult<settings::PlacedLights> changed(const settings::PlacedLights& lights,
                                                            const SetPlacedLights& change);

// `lights` and one more. Refused: an id that is in use, and as `changed`.
[[nodiscard]] CommandResult<settings::PlacedLights> withPicked(const settings::PlacedLights& lights,
                                                               const settings::PlacedLight& picked);

// The canonical JSON of a v1::PlacedLights that has `lights` alone, untrusted. Refused: as
// parseJson, decodePlacedLights and changed, and a set that clears or removes.
[[nodiscard]] CommandResult<settings::PlacedLights> parseLightSet(std::string_view json);

// What parseLightSet reads back as the same.
[[nodiscard]] std::string lightSetJson(const settings::PlacedLights& lights);

// The change that takes `told` to `now`; empty where they are equal.
[[nodiscard]] v1::PlacedLights changeOf(const settings::PlacedLights& told,
                                        const settings::PlacedLights& now);

} // namespace froxel::session
