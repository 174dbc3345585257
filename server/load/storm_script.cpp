#include "load/storm_script.h"

#include "load/orbit_script.h"
#include "session/comparison.h"
#include "session/proto_enums.h"
#include "session/settings.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace froxel::load {
namespace {

using Turn = v1::ClientMessage::BodyCase;
constexpr auto kAll = RandomValues::Fields::kAll;
constexpr auto kSome = RandomValues::Fields::kSome;

constexpr uint32_t kPlacedIds = 200;   // of lights that come and go
constexpr uint32_t kPlacedAtOnce = 16; // at most
constexpr uint32_t kSeeds = 1000;
constexpr uint32_t kMostRampPoints = 8;

// Every command but those about rooms and pausing, and PickLight, which is refused where no light
// is.
constexpr std::array kTurns = {
    Turn::kSetRenderer,     Turn::kSetCamera,
    Turn::kSetLights,       Turn::kSetGrid,
    Turn::kSetExposure,     Turn::kSetCamera,
    Turn::kSetToon,         Turn::kSetSize,
    Turn::kSetEncoding,     Turn::kPing,
    Turn::kSetDelivery,     Turn::kSelectSceneCamera,
    Turn::kSetPost,         Turn::kRequestKeyFrame,
    Turn::kSetDebugView,    Turn::kSetShadows,
    Turn::kSetFog,          Turn::kSetTransparency,
    Turn::kSetPlacedLights, Turn::kSetEnvironment,
    Turn::kSetAnimation,    Turn::kSetMaterialVariant,
    Turn::kSetGeometry,     Turn::kSetCompare,
};

v1::Vec3 vec(double x, double y, double z) {
    v1::Vec3 made;
    made.set_x(x);
    made.set_y(y);
    made.set_z(z);
    return made;
}

settings::SettingValue anyValueOf(const settings::Setting& setting, RandomValues& values) {
    switch (setting.kind) {
    case settings::SettingKind::kSwitch:
        return values.once(2);
    case settings::SettingKind::kWhole:
        return values.whole(static_cast<uint32_t>(setting.min), static_cast<uint32_t>(setting.max));
    case settings::SettingKind::kChoice:
        // Not of several frames.
        return settings::Choice{setting.name == "antialiasing"
                                    ? size_t{0}
                                    : values.whole(1, static_cast<uint32_t>(setting.names.size())) -
                                          1};
    case settings::SettingKind::kReal:
    case settings::SettingKind::kColor:
        break;
    }
    return values.real(setting.min, setting.max);
}

} // namespace

StormScript::StormScript(const v1::Welcome& welcome, uint32_t viewer)
    : start_(welcome.state()),
      cameras_(welcome.scene().cameras().begin(), welcome.scene().cameras().end()),
      material_variants_(static_cast<uint32_t>(welcome.scene().material_variants_size())),
      values_(welcome, viewer) {
    for (const v1::SceneAnimation& animation : welcome.scene().animations()) {
        durations_s_.push_back(animation.duration_s());
    }
}

void StormScript::fillCamera(v1::SetCamera& command) {
    command = orbitPose(start_, values_.real(0, 2 * std::numbers::pi));
    if (values_.once(4)) { // from somewhere, as far ahead as may be
        *command.mutable_eye() = values_.place();
        *command.mutable_target() = command.eye();
        const double ahead = std::max(1.0, values_.within("focus") / 16);
        const double x = command.eye().x();
        command.mutable_target()->set_x(x < 0 ? x + ahead : x - ahead);
    }
    if (values_.once(4)) {
        *command.mutable_up() = vec(values_.real(-1, 1), 1, values_.real(-1, 1));
    }
    command.clear_fov_deg();
    command.clear_half_height_m();
    if (values_.once(8)) {
        command.set_half_height_m(values_.within("half_height"));
    } else {
        command.set_fov_deg(values_.once(2) ? start_.fov_deg() : values_.within("fov_deg"));
    }
    v1::Vec2& shift = *command.mutable_lens_shift();
    if (values_.once(8)) {
        shift.set_x(values_.within("lens_shift.x"));
        shift.set_y(values_.within("lens_shift.y"));
    }
}

void StormScript::fillLights(v1::SetLights& command) {
    values_.fill(command, kSome);
    command.set_seed(values_.once(2) ? values_.whole(0, kSeeds) : values_.whole(0, UINT32_MAX));
    command.clear_clear_box();
    if (command.has_box()) {
        fillBox(*command.mutable_box());
    } else {
        command.set_clear_box(values_.once(2));
    }
}

void StormScript::fillAnimation(v1::SetAnimation& command) {
    values_.fill(command, kSome);
    const uint32_t number = values_.whole(0, static_cast<uint32_t>(durations_s_.size()));
    command.set_animation(number);
    if (number > 0 && values_.once(2)) {
        command.set_time_s(values_.real(0, durations_s_[number - 1]));
    }
}

// Grows to hold a place.
void StormScript::fillBox(v1::Box& box) {
    box = start_.light_box();
    const v1::Vec3 held = values_.place();
    v1::Vec3& least = *box.mutable_min();
    least = vec(std::min(least.x(), held.x()), std::min(least.y(), held.y()),
                std::min(least.z(), held.z()));
    v1::Vec3& most = *box.mutable_max();
    most = vec(std::max(most.x(), held.x()), std::max(most.y(), held.y()),
               std::max(most.z(), held.z()));
}

void StormScript::fillGrid(v1::SetGrid& command) {
    values_.fill(command, kAll);
    if (command.automatic()) {
        command.clear_grid();
    }
}

void StormScript::fillFog(v1::Fog& fog) {
    values_.fill(fog, kSome);
    if (fog.ByteSizeLong() == 0 || values_.once(4)) {
        fog.set_density(0);
    }
}

// All that viewers may choose: this one said that it decodes them.
void StormScript::fillEncoding(v1::SetEncoding& command) {
    values_.fill(command, kSome);
    const uint32_t chosen = values_.whole(1, settings::kChosenCodecNames.size()) - 1;
    command.set_codec(session::toProto<v1::Codec>(settings::kCodecNames, chosen));
}

// A server may have no panorama.
void StormScript::fillEnvironment(v1::SetEnvironment& command) {
    values_.fill(command, kAll);
    if (command.light() == v1::ENVIRONMENT_LIGHT_FILE) {
        command.set_light(v1::ENVIRONMENT_LIGHT_STUDIO);
    }
}

void StormScript::fillToon(v1::SetToon& command) {
    values_.fill(command, kSome);
    for (v1::ToonRamp* ramp : {command.mutable_fragment(), command.mutable_compute()}) {
        const uint32_t count = values_.whole(2, kMostRampPoints);
        for (uint32_t index = 0; index < count; ++index) {
            v1::ToonRamp::Point& point = *ramp->add_points();
            point.set_x((index + values_.real(0, 0.9)) / count);
            point.set_y(values_.within("toon"));
            point.set_slope(values_.within("toon.slope"));
        }
    }
}

// Nothing is compared half of the time.
void StormScript::fillCompare(v1::SetCompare& command) {
    values_.fill(command, kAll);
    command.set_split(values_.within("compare_split"));
    session::SettingChanges right;
    for (const session::SessionSetting& setting : session::sessionSettings()) {
        const settings::Setting& facts = setting.facts();
        if (session::canDiffer(facts) && facts.name != "environment" && values_.once(16)) {
            right.push_back({&setting, anyValueOf(facts, values_)});
        }
    }
    command.set_right(values_.once(2) ? session::textOf(right) : "");
}

void StormScript::fillPlacedLights(v1::PlacedLights& command) {
    command.set_clear(values_.once(8));
    const uint32_t first = values_.whole(1, kPlacedIds);
    const uint32_t count = values_.whole(1, kPlacedAtOnce);
    for (uint32_t id = first; id < first + count; ++id) {
        v1::PlacedLight& light = *command.add_lights();
        values_.fill(light, kAll);
        light.set_id(id);
        *light.mutable_position() = values_.place();
        *light.mutable_direction() = vec(values_.real(-1, 1), -1, values_.real(-1, 1));
        light.set_inner_cone_deg(light.outer_cone_deg() * values_.real(0, 1));
        light.set_radius_m(std::max(light.radius_m(), light.width_m() + light.height_m()));
        if (values_.once(2)) {
            light.set_replaces_seeded(id);
        } else if (values_.once(2)) {
            light.set_replaces_scene(id);
        }
    }
}

// The others need nothing but values in their ranges, and one of their fields at least.
void StormScript::fillOther(v1::ClientMessage& message, int number) {
    const auto& field = *message.GetDescriptor()->FindFieldByNumber(number);
    auto& command = *message.GetReflection()->MutableMessage(&message, &field);
    values_.fill(command, kSome);
    if (command.ByteSizeLong() == 0) {
        values_.fill(command, kAll);
    }
}

void StormScript::fillCommand(v1::ClientMessage& message) {
    const Turn turn = kTurns[count_ % kTurns.size()];
    switch (turn) {
    case Turn::kSelectSceneCamera:
        if (!cameras_.empty()) {
            const auto last = static_cast<uint32_t>(cameras_.size()) - 1;
            message.mutable_select_scene_camera()->set_name(cameras_[values_.whole(0, last)]);
            return;
        }
        [[fallthrough]];
    case Turn::kSetCamera:
        return fillCamera(*message.mutable_set_camera());
    case Turn::kSetLights:
        return fillLights(*message.mutable_set_lights());
    case Turn::kSetAnimation:
        return fillAnimation(*message.mutable_set_animation());
    case Turn::kSetMaterialVariant:
        return message.mutable_set_material_variant()->set_material_variant(
            values_.whole(0, material_variants_));
    case Turn::kSetGrid:
        return fillGrid(*message.mutable_set_grid());
    case Turn::kSetFog:
        return fillFog(*message.mutable_set_fog()->mutable_fog());
    case Turn::kSetGeometry:
        return values_.fill(*message.mutable_set_geometry()->mutable_geometry(), kAll);
    case Turn::kSetEnvironment:
        return fillEnvironment(*message.mutable_set_environment());
    case Turn::kSetToon:
        return fillToon(*message.mutable_set_toon());
    case Turn::kSetEncoding:
        return fillEncoding(*message.mutable_set_encoding());
    case Turn::kSetCompare:
        return fillCompare(*message.mutable_set_compare());
    case Turn::kSetPlacedLights:
        return fillPlacedLights(*message.mutable_set_placed_lights());
    default:
        fillOther(message, turn);
    }
}

std::optional<Step> StormScript::next() {
    Step step;
    step.at = std::chrono::duration_cast<Clock::duration>(
        Seconds(static_cast<double>(count_) / kStormRate));
    fillCommand(step.message);
    ++count_;
    return step;
}

} // namespace froxel::load
