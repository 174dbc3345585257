#include "session/placed_lights.h"

#include "core/assert.h"
#include "session/json_input.h"
#include "session/proto_enums.h"
#include "session/proto_vec.h"

#include <google/protobuf/util/json_util.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace froxel::session {
namespace {

std::string element(const char* list, int index) {
    return std::string(list) + "[" + numberText(index) + "]";
}

std::optional<settings::LightRef>
replacedBy(const std::string& field, const v1::PlacedLight& light, FieldValidator& fields) {
    using Of = settings::LightRef::Of;
    if (light.has_replaces_seeded() && light.has_replaces_scene()) {
        fields.fail(RejectCode::kOutOfRange, field + ".replaces_scene",
                    "is set together with replaces_seeded; a light replaces at most one");
    }
    if (light.has_replaces_seeded()) {
        return settings::LightRef{Of::kSeed,
                                  fields.number(field + ".replaces_seeded",
                                                settings::kReplacedRange, light.replaces_seeded())};
    }
    if (light.has_replaces_scene()) {
        return settings::LightRef{Of::kScene,
                                  fields.number(field + ".replaces_scene", settings::kReplacedRange,
                                                light.replaces_scene())};
    }
    return std::nullopt;
}

PlacedLightChange
decodeLight(const std::string& field, const v1::PlacedLight& light, FieldValidator& fields) {
    PlacedLightChange change;
    change.id = fields.number(field + ".id", settings::kPlacedIdRange, light.id());
    if (light.has_kind()) {
        change.kind = static_cast<settings::LightKind>(
            enumIndex(fields, field + ".kind", *v1::LightKind_descriptor(),
                      numbersOf<v1::LightKind>(settings::kLightKindNames), light.kind()));
    }
    if (light.has_position()) {
        change.position_world = fields.position(field + ".position", vec(light.position()));
    }
    if (light.has_direction()) {
        change.direction_world = vec(light.direction());
        fields.number(field + ".direction", settings::kUpRange,
                      glm::length(*change.direction_world));
    }
    if (light.has_color()) {
        const glm::dvec3 color = vec(light.color());
        for (const double part : {color.x, color.y, color.z}) {
            fields.number(field + ".color", settings::kPlacedColorRange, part);
        }
        change.color = glm::vec3(color);
    }
    if (light.has_intensity()) {
        change.intensity =
            fields.number(field + ".intensity", settings::kLightIntensityRange, light.intensity());
    }
    if (light.has_radius_m()) {
        change.radius_m =
            fields.number(field + ".radius_m", settings::kLightRadiusRange, light.radius_m());
    }
    if (light.has_inner_cone_deg()) {
        change.inner_cone_deg =
            fields.number(field + ".inner_cone_deg", settings::kConeRange, light.inner_cone_deg());
    }
    if (light.has_outer_cone_deg()) {
        change.outer_cone_deg =
            fields.number(field + ".outer_cone_deg", settings::kConeRange, light.outer_cone_deg());
    }
    if (light.has_width_m()) {
        change.width_m =
            fields.number(field + ".width_m", settings::kAreaSideRange, light.width_m());
    }
    if (light.has_height_m()) {
        change.height_m =
            fields.number(field + ".height_m", settings::kAreaSideRange, light.height_m());
    }
    if (light.has_roll_deg()) {
        change.roll_deg =
            fields.number(field + ".roll_deg", settings::kRollRange, light.roll_deg());
    }
    change.replaces = replacedBy(field, light, fields);
    return change;
}

void apply(const PlacedLightChange& change, settings::PlacedLight& light) {
    light.id = change.id;
    light.kind = change.kind.value_or(light.kind);
    light.position_world = change.position_world.value_or(light.position_world);
    light.direction_world = change.direction_world.value_or(light.direction_world);
    light.color = change.color.value_or(light.color);
    light.intensity =
        static_cast<float>(change.intensity.value_or(static_cast<double>(light.intensity)));
    light.radius_m =
        static_cast<float>(change.radius_m.value_or(static_cast<double>(light.radius_m)));
    light.inner_cone_deg = change.inner_cone_deg.value_or(light.inner_cone_deg);
    light.outer_cone_deg = change.outer_cone_deg.value_or(light.outer_cone_deg);
    light.width_m = change.width_m.value_or(light.width_m);
    light.height_m = change.height_m.value_or(light.height_m);
    light.roll_deg = change.roll_deg.value_or(light.roll_deg);
    light.replaces = change.replaces ? change.replaces : light.replaces;
}

void fill(v1::PlacedLight& out, const settings::PlacedLight& light) {
    out.set_id(light.id);
    out.set_kind(toProto<v1::LightKind>(settings::kLightKindNames, light.kind));
    fillVec(*out.mutable_position(), light.position_world);
    fillVec(*out.mutable_direction(), light.direction_world);
    fillVec(*out.mutable_color(), glm::dvec3(light.color));
    out.set_intensity(static_cast<double>(light.intensity));
    out.set_radius_m(static_cast<double>(light.radius_m));
    out.set_inner_cone_deg(light.inner_cone_deg);
    out.set_outer_cone_deg(light.outer_cone_deg);
    out.set_width_m(light.width_m);
    out.set_height_m(light.height_m);
    out.set_roll_deg(light.roll_deg);
    if (light.replaces && light.replaces->of == settings::LightRef::Of::kSeed) {
        out.set_replaces_seeded(light.replaces->index);
    } else if (light.replaces) {
        out.set_replaces_scene(light.replaces->index);
    }
}

using LightsById = std::map<uint32_t, settings::PlacedLight>;

LightsById byId(const settings::PlacedLights& lights) {
    LightsById by_id;
    for (const settings::PlacedLight& light : lights.lights()) {
        by_id.emplace(light.id, light);
    }
    return by_id;
}

// What is wrong with a light whose values are all in their ranges.
std::optional<Rejection> faultOf(const std::string& field, const settings::PlacedLight& light) {
    const double corner_m = 0.5 * std::hypot(light.width_m, light.height_m);
    const auto radius_m = static_cast<double>(light.radius_m);
    if (light.kind == settings::LightKind::kArea && radius_m < corner_m) {
        return outOfRange(field + ".radius_m",
                          "is " + numberText(radius_m) +
                              "; the rectangle's corners must lie within it; they are at " +
                              numberText(corner_m));
    }
    if (light.inner_cone_deg > light.outer_cone_deg) {
        return outOfRange(field + ".inner_cone_deg", "is " + numberText(light.inner_cone_deg) +
                                                         "; it must be at most outer_cone_deg, " +
                                                         numberText(light.outer_cone_deg));
    }
    return std::nullopt;
}

// The ids of two lights that stand for the same.
std::optional<std::pair<uint32_t, uint32_t>> rivals(const LightsById& lights) {
    std::map<settings::LightRef, uint32_t> ids;
    for (const auto& [id, light] : lights) {
        if (light.replaces) {
            const auto [known, first] = ids.emplace(*light.replaces, id);
            if (!first) {
                return std::pair(known->second, id);
            }
        }
    }
    return std::nullopt;
}

// If they can be together.
CommandResult<settings::PlacedLights> kept(const LightsById& by_id) {
    if (const auto both = rivals(by_id)) {
        return outOfRange("lights", numberText(both->first) + " and " + numberText(both->second) +
                                        " would replace the same light; only one can");
    }
    if (by_id.size() > settings::kPlacedCountRange.max) {
        return outOfRange("lights", "would be " + numberText(by_id.size()) + "; at most " +
                                        numberText(settings::kPlacedCountRange.max) + " are kept");
    }
    std::vector<settings::PlacedLight> ordered;
    ordered.reserve(by_id.size());
    for (const auto& [id, light] : by_id) {
        ordered.push_back(light);
    }
    return settings::PlacedLights(std::move(ordered));
}

} // namespace

SetPlacedLights decodePlacedLights(const v1::PlacedLights& set, FieldValidator& fields) {
    fields.require(set.clear() || set.remove_size() > 0 || set.lights_size() > 0, "lights");
    SetPlacedLights command;
    command.clear = set.clear();
    command.remove.assign(set.remove().begin(), set.remove().end());
    std::set<uint32_t> ids;
    for (int i = 0; i < set.lights_size(); ++i) {
        const std::string field = element("lights", i);
        command.lights.push_back(decodeLight(field, set.lights(i), fields));
        if (!ids.insert(set.lights(i).id()).second) {
            fields.fail(RejectCode::kOutOfRange, field + ".id",
                        "is " + numberText(set.lights(i).id()) + "; another light already has it");
        }
    }
    return command;
}

CommandResult<settings::PlacedLights> changed(const settings::PlacedLights& lights,
                                              const SetPlacedLights& change) {
    LightsById by_id = change.clear ? LightsById() : byId(lights);
    for (size_t i = 0; i < change.remove.size(); ++i) {
        if (by_id.erase(change.remove[i]) == 0) {
            return outOfRange(element("remove", static_cast<int>(i)),
                              "is " + numberText(change.remove[i]) + "; no such light exists");
        }
    }
    for (size_t i = 0; i < change.lights.size(); ++i) {
        const PlacedLightChange& wanted = change.lights[i];
        const std::string field = element("lights", static_cast<int>(i));
        const auto [light, added] = by_id.try_emplace(wanted.id);
        if (added && !wanted.position_world) {
            return outOfRange(field + ".position",
                              "is missing; light " + numberText(wanted.id) + " does not exist yet");
        }
        apply(wanted, light->second);
        if (auto fault = faultOf(field, light->second)) {
            return *fault;
        }
    }
    return kept(by_id);
}

CommandResult<settings::PlacedLights> parseLightSet(std::string_view json) {
    v1::PlacedLights set;
    if (const auto parsed =
            parseJson({reinterpret_cast<const std::byte*>(json.data()), json.size()}, set);
        !parsed) {
        return parsed.error();
    }
    if (set.ByteSizeLong() == 0) { // a command of nothing is none, a set of none is one
        return settings::PlacedLights();
    }
    FieldValidator fields;
    const SetPlacedLights command = decodePlacedLights(set, fields);
    if (fields.rejection()) {
        return *fields.rejection();
    }
    if (command.clear || !command.remove.empty()) {
        const std::string field = command.clear ? "clear" : "remove";
        return outOfRange(field, "is set; a light set may contain only lights");
    }
    return changed({}, command);
}

v1::PlacedLights changeOf(const settings::PlacedLights& told, const settings::PlacedLights& now) {
    v1::PlacedLights change;
    for (const settings::PlacedLight& light : told.lights()) {
        const settings::PlacedLight* after = now.find(light.id);
        // What a light stands for cannot be taken back by a field that is absent.
        if (after == nullptr || (light.replaces && light.replaces != after->replaces)) {
            change.add_remove(light.id);
        }
    }
    for (const settings::PlacedLight& light : now.lights()) {
        const settings::PlacedLight* before = told.find(light.id);
        if (before == nullptr || !(*before == light)) {
            fill(*change.add_lights(), light);
        }
    }
    return change;
}

CommandResult<settings::PlacedLights> withPicked(const settings::PlacedLights& lights,
                                                 const settings::PlacedLight& picked) {
    if (lights.find(picked.id) != nullptr) {
        return outOfRange("id", "is " + numberText(picked.id) + "; another light already has it");
    }
    if (auto fault = faultOf(element("lights", 0), picked)) {
        return *fault;
    }
    LightsById by_id = byId(lights);
    by_id.emplace(picked.id, picked);
    return kept(by_id);
}

std::string lightSetJson(const settings::PlacedLights& lights) {
    std::string json;
    const auto written = google::protobuf::util::MessageToJsonString(changeOf({}, lights), &json);
    FROXEL_ASSERT(written.ok(), "a light set must be JSON");
    return json;
}

} // namespace froxel::session
