#include "session/command_decode.h"

#include "froxel/v1/client.pb.h"
#include "protocol/limits.h"
#include "session/field_validator.h"
#include "session/json_input.h"
#include "session/placed_lights.h"
#include "session/proto_enums.h"
#include "session/proto_vec.h"
#include "session/room.h"
#include "session/setting_fields.h"

#include <climits>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/stubs/logging.h>

namespace froxel::session {
namespace {

// ClientMessage is four messages deep; the rest is room for newer clients' fields.
constexpr int kMaxRecursion = 16;

CommandResult<void> parseBinary(protocol::ByteSpan bytes, v1::ClientMessage& message) {
    const auto size = static_cast<int>(std::min<size_t>(bytes.size(), INT_MAX));
    google::protobuf::io::CodedInputStream stream(reinterpret_cast<const uint8_t*>(bytes.data()),
                                                  size);
    stream.SetRecursionLimit(kMaxRecursion);
    if (!message.ParseFromCodedStream(&stream) || !stream.ConsumedEntireMessage()) {
        return Rejection{RejectCode::kMalformed, 0, "", "not a ClientMessage"};
    }
    return {};
}

Command decode(const v1::Hello& hello, FieldValidator& fields) {
    if (!hello.room().empty() && !isRoomName(hello.room())) {
        fields.fail(RejectCode::kOutOfRange, "room",
                    "is \"" + printable(hello.room()) + "\"; it must be 1 to " +
                        numberText(protocol::kMaxRoomNameBytes) + " of A-Z a-z 0-9 . _ -");
    }
    Hello command;
    command.major = hello.protocol_major();
    command.minor = hello.protocol_minor();
    command.client_name =
        fields.text("client_name", hello.client_name(), protocol::kMaxClientNameBytes);
    command.room = hello.room();
    command.resume_token = hello.resume_token();
    command.token = fields.text("token", hello.token(), protocol::kMaxTokenBytes);
    for (const int codec : hello.codecs()) {
        if (const auto known =
                fromProto<settings::Codec>(settings::kCodecNames, static_cast<v1::Codec>(codec))) {
            command.codecs.set(static_cast<size_t>(*known));
        }
    }
    return command;
}

Command decode(const v1::SetCamera& camera, FieldValidator& fields) {
    fields.require(camera.has_eye(), "eye");
    fields.require(camera.has_target(), "target");
    SetCamera command;
    command.eye_world = fields.position("eye", vec(camera.eye()));
    command.target_world = fields.position("target", vec(camera.target()));
    fields.number(settings::kFocusRange, glm::distance(command.eye_world, command.target_world));
    if (camera.has_up()) {
        command.up_world = fields.position("up", vec(camera.up()));
        fields.number(settings::kUpRange, glm::length(command.up_world));
    }
    if (camera.has_fov_deg()) {
        command.yfov_rad = glm::radians(fields.number(settings::kFovRange, camera.fov_deg()));
    }
    if (camera.has_half_height_m()) {
        command.half_height_m = fields.number(settings::kHalfHeightRange, camera.half_height_m());
    }
    if (camera.has_lens_shift()) {
        const v1::Vec2& shift = camera.lens_shift();
        command.lens_shift = {fields.number(settings::kLensShiftXRange, shift.x()),
                              fields.number(settings::kLensShiftYRange, shift.y())};
    }
    if (command.yfov_rad && command.half_height_m) {
        fields.fail(RejectCode::kOutOfRange, settings::kHalfHeightRange.field,
                    "is set together with fov_deg; set one of them");
    }
    return command;
}

Command decode(const v1::SelectSceneCamera& select, FieldValidator& fields) {
    if (select.name().size() > protocol::kMaxNameBytes) {
        fields.fail(RejectCode::kOutOfRange, "name",
                    "has " + numberText(select.name().size()) + " bytes; at most " +
                        numberText(protocol::kMaxNameBytes) + " are allowed");
    }
    return SelectSceneCamera{select.name()};
}

Command decode(const v1::SelectScene& select, FieldValidator& fields) {
    return SelectScene{fields.text("scene", select.scene(), protocol::kMaxSceneIdBytes)};
}

BoundsD3 decodeBox(const v1::Box& box, FieldValidator& fields) {
    fields.require(box.has_min(), "light_box.min");
    fields.require(box.has_max(), "light_box.max");
    BoundsD3 bounds;
    bounds.min = fields.position("light_box.min", vec(box.min()));
    bounds.max = fields.position("light_box.max", vec(box.max()));
    for (int axis = 0; axis < 3; ++axis) {
        if (!(bounds.min[axis] < bounds.max[axis])) {
            fields.fail(RejectCode::kOutOfRange, "light_box",
                        std::string("has ") + "xyz"[axis] + " from " +
                            numberText(bounds.min[axis]) + " to " + numberText(bounds.max[axis]) +
                            "; min must be below max");
        }
    }
    return bounds;
}

Command decode(const v1::SetLights& lights, FieldValidator& fields) {
    SetLights command{{decodeSettings(lights, fields)}};
    if (lights.has_box()) {
        command.box = decodeBox(lights.box(), fields);
    }
    command.clear_box = lights.clear_box();
    if (command.box && command.clear_box) {
        fields.fail(RejectCode::kOutOfRange, "clear_box",
                    "is set together with box; send one of them");
    }
    if (lights.has_time_s()) {
        command.time_s = fields.number(settings::kTimeRange, lights.time_s());
    }
    return command;
}

Command decode(const v1::SetAnimation& set, FieldValidator& fields) {
    SetAnimation command{{decodeSettings(set, fields)}};
    if (set.has_animation()) {
        command.number = set.animation();
    }
    if (set.has_time_s()) {
        command.time_s = fields.number("animation_time", settings::kTimeRange, set.time_s());
    }
    return command;
}

Command decode(const v1::SetMaterialVariant& set, FieldValidator& fields) {
    fields.require(set.has_material_variant(), "material_variant");
    return SetMaterialVariant{set.material_variant()};
}

Command decode(const v1::PickLight& pick, FieldValidator& fields) {
    PickLight command;
    command.id = fields.number("id", settings::kPlacedIdRange, pick.id());
    command.at = {fields.number("x", settings::kPickRange, pick.x()),
                  fields.number("y", settings::kPickRange, pick.y())};
    return command;
}

Command decode(const v1::SetGrid& set, FieldValidator& fields) {
    fields.require(set.has_grid() || set.has_automatic() || set.has_law(), "grid");
    SetGrid command{{decodeSettings(set, fields)}};
    if (set.has_grid()) {
        const v1::Grid& grid = set.grid();
        command.size = {fields.number(settings::kGridXRange, grid.x()),
                        fields.number(settings::kGridYRange, grid.y()),
                        fields.number(settings::kGridZRange, grid.z())};
    }
    if (set.has_automatic()) {
        command.automatic = set.automatic();
    }
    if (command.size && command.automatic.value_or(false)) {
        fields.fail(RejectCode::kOutOfRange, "automatic",
                    "is true together with grid; send one of them");
    }
    return command;
}

settings::ToonRamp
decodeRamp(const std::string& name, const v1::ToonRamp& ramp, FieldValidator& fields) {
    const auto count = static_cast<uint32_t>(ramp.points_size());
    if (count < 2 || count > settings::ToonRamp::kMaxPoints) {
        fields.fail(RejectCode::kOutOfRange, name,
                    "has " + numberText(count) + " points; it must have 2 to " +
                        numberText(settings::ToonRamp::kMaxPoints));
        return {};
    }
    settings::ToonRamp command;
    command.count = count;
    command.points = {};
    for (uint32_t i = 0; i < count; ++i) {
        const v1::ToonRamp::Point& point = ramp.points(static_cast<int>(i));
        const std::string field = name + ".points[" + numberText(i) + "]";
        const auto number = [&](const char* part, const settings::Range<double>& range,
                                double value) {
            return static_cast<float>(fields.number(field + part, range, value));
        };
        command.points[i] = {number(".x", settings::kToonRange, point.x()),
                             number(".y", settings::kToonRange, point.y()),
                             number(".slope", settings::kToonSlopeRange, point.slope())};
        // In float, as the shader will see them: equal neighbours would divide by zero.
        if (i > 0 && !(command.points[i].x > command.points[i - 1].x)) {
            fields.fail(RejectCode::kOutOfRange, field + ".x",
                        "is " + numberText(point.x()) + "; it must be above " +
                            numberText(command.points[i - 1].x) + ", the one before it");
        }
    }
    return command;
}

Command decode(const v1::SetToon& toon, FieldValidator& fields) {
    SetToon command{{decodeSettings(toon, fields)}};
    if (toon.has_fragment()) {
        command.fragment = decodeRamp("toon_fragment", toon.fragment(), fields);
    }
    if (toon.has_compute()) {
        command.compute = decodeRamp("toon_compute", toon.compute(), fields);
    }
    return command;
}

Command decode(const v1::SetDebugView& set, FieldValidator& fields) {
    fields.require(set.has_view() || set.has_scale_max() || set.has_freeze(), "debug_view");
    SetDebugView command{{decodeSettings(set, fields)}};
    if (set.has_freeze()) {
        command.freeze = set.freeze();
    }
    return command;
}

Command decode(const v1::SetCompare& set, FieldValidator& fields) {
    fields.require(set.has_right() || set.has_split() || set.has_show(), "right");
    SetCompare command;
    if (set.has_right()) {
        fields.text("right", set.right(), protocol::kMaxCompareBytes);
        auto right = parseRight(set.right());
        if (!right) {
            fields.fail(right.error());
        } else {
            command.right = std::move(*right);
        }
    }
    if (set.has_split()) {
        command.split = fields.number("split", settings::kCompareSplitRange, set.split());
    }
    if (set.has_show()) {
        command.show = static_cast<CompareShow>(
            enumIndex(fields, "show", *v1::CompareShow_descriptor(),
                      numbersOf<v1::CompareShow>(kCompareShowNames), set.show()));
    }
    return command;
}

Command decode(const v1::SetSize& size, FieldValidator& fields) {
    return SetSize{{fields.number(settings::kWidthRange, size.width()),
                    fields.number(settings::kHeightRange, size.height())}};
}

// Null: it gives something else, or besides.
const google::protobuf::Message* settingsAlone(const v1::ClientMessage& message) {
    const auto* body = v1::ClientMessage::descriptor()->FindFieldByNumber(message.body_case());
    return body != nullptr && holdsSettingsAlone(*body->message_type())
               ? &message.GetReflection()->GetMessage(message, body)
               : nullptr;
}

Command decodeBody(const v1::ClientMessage& message, FieldValidator& fields) {
    if (const auto* settings = settingsAlone(message)) {
        return SetSettings{decodeSettings(*settings, fields)};
    }
    switch (message.body_case()) {
    case v1::ClientMessage::kHello:
        return decode(message.hello(), fields);
    case v1::ClientMessage::kSetCamera:
        return decode(message.set_camera(), fields);
    case v1::ClientMessage::kSelectSceneCamera:
        return decode(message.select_scene_camera(), fields);
    case v1::ClientMessage::kSelectScene:
        return decode(message.select_scene(), fields);
    case v1::ClientMessage::kSetLights:
        return decode(message.set_lights(), fields);
    case v1::ClientMessage::kSetAnimation:
        return decode(message.set_animation(), fields);
    case v1::ClientMessage::kSetMaterialVariant:
        return decode(message.set_material_variant(), fields);
    case v1::ClientMessage::kSetPlacedLights:
        return decodePlacedLights(message.set_placed_lights(), fields);
    case v1::ClientMessage::kPickLight:
        return decode(message.pick_light(), fields);
    case v1::ClientMessage::kSetGrid:
        return decode(message.set_grid(), fields);
    case v1::ClientMessage::kSetToon:
        return decode(message.set_toon(), fields);
    case v1::ClientMessage::kSetDebugView:
        return decode(message.set_debug_view(), fields);
    case v1::ClientMessage::kSetCompare:
        return decode(message.set_compare(), fields);
    case v1::ClientMessage::kSetSize:
        return decode(message.set_size(), fields);
    case v1::ClientMessage::kAck:
        return Ack{message.ack().frame_id(), message.ack().receive_to_paint_us(),
                   message.ack().decode_us()};
    case v1::ClientMessage::kPing:
        return Ping{};
    case v1::ClientMessage::kRequestControl:
        return RequestControl{};
    case v1::ClientMessage::kReleaseControl:
        return ReleaseControl{};
    case v1::ClientMessage::kGiveControl:
        return GiveControl{message.give_control().member_id()};
    case v1::ClientMessage::kPause:
        return Pause{message.pause().paused()};
    case v1::ClientMessage::kRequestDepth:
        return RequestDepth{message.request_depth().wanted()};
    case v1::ClientMessage::kRequestKeyFrame:
        return RequestKeyFrame{};
    default:
        break;
    }
    fields.fail(RejectCode::kUnsupported, "body", "is not a command of this server");
    return Ping{};
}

} // namespace

CommandResult<CommandMessage> decodeCommand(protocol::ByteSpan bytes, protocol::WireFormat format) {
    // Otherwise protobuf writes to stderr about a client's invalid UTF-8: a flood for the asking.
    const google::protobuf::LogSilencer silence;
    v1::ClientMessage message;
    const auto parsed = format == protocol::WireFormat::kText ? parseJson(bytes, message)
                                                              : parseBinary(bytes, message);
    if (!parsed) {
        return parsed.error();
    }
    if (message.seq() == 0) {
        return Rejection{RejectCode::kMalformed, 0, "seq", "seq is missing or 0; it counts from 1"};
    }
    FieldValidator fields;
    Command body = decodeBody(message, fields);
    if (fields.rejection()) {
        Rejection rejection = *fields.rejection();
        rejection.ref_seq = message.seq();
        return rejection;
    }
    return CommandMessage{{message.seq(), message.client_time_us()}, std::move(body)};
}

} // namespace froxel::session
