// What command.h promises of every command that was let in: renderers rely on it.
#pragma once

#include "core/text.h"
#include "session/command.h"
#include "session/rejection.h"
#include "settings/ranges.h"
#include "support/setting_values.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

namespace froxel::test {

struct PromiseKept {
    static bool finite(const glm::dvec3& value) {
        return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
    }
    bool operator()(const session::SetCamera& c) const {
        return finite(c.eye_world) && finite(c.target_world) && finite(c.up_world) &&
               c.eye_world != c.target_world && glm::length(c.up_world) > 0 &&
               (!c.yfov_rad || (*c.yfov_rad > 0 && *c.yfov_rad < 3.1));
    }
    static bool inRange(const session::SettingChanges& changes) {
        return std::all_of(changes.begin(), changes.end(), [](const auto& change) {
            return accepts(change.setting->facts(), change.value);
        });
    }
    bool operator()(const session::SetSettings& c) const { return inRange(c.changes); }
    bool operator()(const session::SetLights& c) const {
        return inRange(c.changes) &&
               (!c.box || (finite(c.box->min) && finite(c.box->max) && !c.box->empty()));
    }
    bool operator()(const session::SetPlacedLights& c) const {
        return std::all_of(
            c.lights.begin(), c.lights.end(), [](const session::PlacedLightChange& light) {
                return light.id > 0 && (!light.position_world || finite(*light.position_world)) &&
                       (!light.direction_world || glm::length(*light.direction_world) > 0) &&
                       (!light.radius_m || settings::kLightRadiusRange.contains(*light.radius_m));
            });
    }
    bool operator()(const session::PickLight& c) const {
        return c.id > 0 && std::abs(c.at.x) <= 1 && std::abs(c.at.y) <= 1;
    }
    bool operator()(const session::SetGrid& c) const {
        return (!c.size || (c.size->x > 0 && c.size->y > 0 && c.size->z > 0 && c.size->x <= 128)) &&
               !(c.size && c.automatic.value_or(false)) && inRange(c.changes);
    }
    bool operator()(const session::SetDebugView& c) const { return inRange(c.changes); }
    bool operator()(const session::SetSize& c) const {
        return settings::kWidthRange.contains(c.size.width_px) &&
               settings::kHeightRange.contains(c.size.height_px);
    }
    bool operator()(const session::SetToon& c) const {
        return (!c.compute || c.compute->count >= 2) && (!c.fragment || c.fragment->count >= 2) &&
               inRange(c.changes);
    }
    template <class Other>
    bool operator()(const Other& /*command*/) const {
        return true;
    }
};

// What is wrong with an answer to a client's message; empty where it is as promised.
inline std::string faultOf(const session::CommandResult<session::CommandMessage>& result) {
    if (result) {
        const bool kept = result->stamp.seq > 0 && std::visit(PromiseKept{}, result->body);
        return kept ? "" : "command " + numberText(result->body.index()) + " breaks a promise";
    }
    const std::string& line = result.error().message;
    return !line.empty() && line.size() < 500 && printable(line, 500) == line
               ? ""
               : "not one short line: " + line;
}

} // namespace froxel::test
