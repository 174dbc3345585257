// Binary messages: every command once, and what is wrong with a message as a whole.
#include "core/text.h"
#include "session/command_decode.h"
#include "support/settings.h"
#include "unit/session/messages.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace froxel::session {
namespace {

using test::givenBy;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

v1::Vec3* set(v1::Vec3* out, double x, double y, double z) {
    out->set_x(x);
    out->set_y(y);
    out->set_z(z);
    return out;
}

v1::ClientMessage cameraMessage() {
    v1::ClientMessage message = clientMessage();
    set(message.mutable_set_camera()->mutable_eye(), 1, 2, 3);
    set(message.mutable_set_camera()->mutable_target(), 4, 5, 6);
    return message;
}

TEST(DecodeCommand, Stamp_IsTaken) {
    v1::ClientMessage message = clientMessage(std::numeric_limits<uint64_t>::max());
    message.set_client_time_us(77);
    message.mutable_ping();
    const auto result = decodeBinary(message);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->stamp, (CommandStamp{std::numeric_limits<uint64_t>::max(), 77}));
    accepted<Ping>(result);
}

TEST(DecodeCommand, Hello_IsTakenAndItsNameBounded) {
    v1::ClientMessage message = clientMessage();
    message.mutable_hello()->set_protocol_major(3);
    message.mutable_hello()->set_protocol_minor(4);
    message.mutable_hello()->set_client_name(std::string(64, 'n'));
    const auto hello = accepted<Hello>(decodeBinary(message));
    EXPECT_EQ(hello.major, 3U);
    EXPECT_EQ(hello.minor, 4U);
    EXPECT_EQ(hello.client_name.size(), 64U);
    message.mutable_hello()->set_client_name(std::string(65, 'n'));
    EXPECT_EQ(refused(decodeBinary(message)).message,
              "client_name has 65 bytes; at most 64 are allowed");
}

TEST(DecodeCommand, SetCamera_TakesWhatIsThere) {
    const auto plain = accepted<SetCamera>(decodeBinary(cameraMessage()));
    EXPECT_EQ(plain.eye_world, glm::dvec3(1, 2, 3));
    EXPECT_EQ(plain.target_world, glm::dvec3(4, 5, 6));
    EXPECT_EQ(plain.up_world, glm::dvec3(0, 1, 0));
    EXPECT_FALSE(plain.yfov_rad || plain.half_height_m);

    v1::ClientMessage message = cameraMessage();
    set(message.mutable_set_camera()->mutable_up(), 0, 0, -2);
    message.mutable_set_camera()->set_fov_deg(90);
    const auto full = accepted<SetCamera>(decodeBinary(message));
    EXPECT_EQ(full.up_world, glm::dvec3(0, 0, -2));
    EXPECT_DOUBLE_EQ(full.yfov_rad.value(), std::acos(0.0));
}

TEST(DecodeCommand, SetCamera_NonFiniteNumbers_AreRefusedByName) {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        v1::ClientMessage message = cameraMessage();
        message.mutable_set_camera()->mutable_eye()->set_y(bad);
        const Rejection rejection = refused(decodeBinary(message));
        EXPECT_EQ(rejection.code, RejectCode::kOutOfRange);
        EXPECT_EQ(rejection.field, "eye.y");
        EXPECT_EQ(rejection.ref_seq, 1U);
        EXPECT_EQ(rejection.message,
                  "eye.y is " + numberText(bad) + "; it must be from -10000000 to 10000000");
    }
}

TEST(DecodeCommand, SetCamera_WithoutADirection_IsRefused) {
    v1::ClientMessage same = cameraMessage();
    *same.mutable_set_camera()->mutable_target() = same.set_camera().eye();
    EXPECT_EQ(refused(decodeBinary(same)).field, "focus");

    v1::ClientMessage denormal = cameraMessage();
    set(denormal.mutable_set_camera()->mutable_eye(), 0, 0, 0);
    set(denormal.mutable_set_camera()->mutable_target(), 5e-324, 0, 0);
    EXPECT_EQ(refused(decodeBinary(denormal)).field, "focus");

    v1::ClientMessage no_up = cameraMessage();
    no_up.mutable_set_camera()->mutable_up();
    EXPECT_EQ(refused(decodeBinary(no_up)).message,
              "up is 0; it must be from 0.000001 to 100000000");

    v1::ClientMessage no_eye = cameraMessage();
    no_eye.mutable_set_camera()->clear_eye();
    EXPECT_EQ(refused(decodeBinary(no_eye)).message, "eye is missing");
    v1::ClientMessage no_target = cameraMessage();
    no_target.mutable_set_camera()->clear_target();
    EXPECT_EQ(refused(decodeBinary(no_target)).message, "target is missing");
}

TEST(DecodeCommand, SetCamera_TwoProjections_AreRefused) {
    v1::ClientMessage message = cameraMessage();
    message.mutable_set_camera()->set_fov_deg(45);
    message.mutable_set_camera()->set_half_height_m(3);
    EXPECT_EQ(refused(decodeBinary(message)).field, "half_height");
    message.mutable_set_camera()->clear_fov_deg();
    EXPECT_EQ(accepted<SetCamera>(decodeBinary(message)).half_height_m, 3.0);
}

TEST(DecodeCommand, SelectSceneCamera_NameIsBounded) {
    v1::ClientMessage message = clientMessage();
    message.mutable_select_scene_camera()->set_name(std::string(256, 'c'));
    EXPECT_EQ(accepted<SelectSceneCamera>(decodeBinary(message)).name.size(), 256U);
    message.mutable_select_scene_camera()->set_name(std::string(257, 'c'));
    EXPECT_EQ(refused(decodeBinary(message)).field, "name");
}

TEST(DecodeCommand, SetLights_AbsentStaysAbsent_ZeroIsAValue) {
    v1::ClientMessage empty = clientMessage();
    empty.mutable_set_lights();
    const auto none = accepted<SetLights>(decodeBinary(empty));
    EXPECT_FALSE(!none.changes.empty() || none.box || none.clear_box || none.time_s);

    v1::ClientMessage zeros = clientMessage();
    v1::SetLights& lights = *zeros.mutable_set_lights();
    lights.set_count(0);
    lights.set_intensity(0);
    lights.set_animate(false);
    const auto command = accepted<SetLights>(decodeBinary(zeros));
    EXPECT_EQ(command.changes.size(), 3U);
    EXPECT_EQ(givenBy<uint32_t>(command, "lights"), 0U);
    EXPECT_EQ(givenBy<double>(command, "light_intensity"), 0.0);
    EXPECT_EQ(givenBy<bool>(command, "animate"), false);
}

TEST(DecodeCommand, SetLights_BoxMustHaveVolume) {
    v1::ClientMessage message = clientMessage();
    v1::Box& box = *message.mutable_set_lights()->mutable_box();
    set(box.mutable_min(), -1, -2, -3);
    EXPECT_EQ(refused(decodeBinary(message)).field, "light_box.max");
    set(box.mutable_max(), 1, 2, 3);
    const auto command = accepted<SetLights>(decodeBinary(message));
    EXPECT_EQ(command.box->min, glm::dvec3(-1, -2, -3));
    EXPECT_EQ(command.box->max, glm::dvec3(1, 2, 3));

    box.mutable_max()->set_y(-2);
    EXPECT_EQ(refused(decodeBinary(message)).message,
              "light_box has y from -2 to -2; min must be below max");
    box.mutable_max()->set_y(kNan);
    EXPECT_EQ(refused(decodeBinary(message)).field, "light_box.max.y");
    box.mutable_max()->set_y(2);
    message.mutable_set_lights()->set_clear_box(true);
    EXPECT_EQ(refused(decodeBinary(message)).field, "clear_box");
}

TEST(DecodeCommand, SetGridAutomatic_TogetherWithAGrid_OnlyWhereItIsOff) {
    v1::ClientMessage message = clientMessage();
    v1::SetGrid& set = *message.mutable_set_grid();
    set.set_automatic(true);
    EXPECT_EQ(accepted<SetGrid>(decodeBinary(message)).automatic, true);
    set.mutable_grid()->set_x(5);
    set.mutable_grid()->set_y(5);
    set.mutable_grid()->set_z(5);
    EXPECT_EQ(refused(decodeBinary(message)).field, "automatic");
    set.set_automatic(false);
    EXPECT_EQ(accepted<SetGrid>(decodeBinary(message)).size, (settings::GridSize{5, 5, 5}));
}

TEST(DecodeCommand, SizeAndAck_AreTaken) {
    v1::ClientMessage size = clientMessage();
    size.mutable_set_size()->set_width(1281);
    size.mutable_set_size()->set_height(17);
    EXPECT_EQ(accepted<SetSize>(decodeBinary(size)).size, (settings::Size{1281, 17}));
    v1::ClientMessage ack = clientMessage();
    ack.mutable_ack()->set_frame_id(std::numeric_limits<uint64_t>::max());
    EXPECT_EQ(accepted<Ack>(decodeBinary(ack)).frame_id, std::numeric_limits<uint64_t>::max());
    EXPECT_EQ(accepted<Ack>(decodeBinary(ack)).receive_to_paint_us, 0U);
    ack.mutable_ack()->set_receive_to_paint_us(12'345);
    ack.mutable_ack()->set_decode_us(678);
    EXPECT_EQ(accepted<Ack>(decodeBinary(ack)).receive_to_paint_us, 12'345U);
    EXPECT_EQ(accepted<Ack>(decodeBinary(ack)).decode_us, 678U);
}

TEST(DecodeCommand, NoSeq_IsMalformed) {
    v1::ClientMessage message;
    message.mutable_ping();
    EXPECT_EQ(refused(decodeBinary(message)).code, RejectCode::kMalformed);
    EXPECT_EQ(refused(decodeBinary(message)).field, "seq");
    EXPECT_EQ(refused(decodeBinary("")).field, "seq");
}

TEST(DecodeCommand, NoBodyOrAnUnknownOne_IsUnsupported) {
    EXPECT_EQ(refused(decodeBinary(clientMessage(4))).code, RejectCode::kUnsupported);
    EXPECT_EQ(refused(decodeBinary(clientMessage(4))).ref_seq, 4U);
    // Field 99 of ClientMessage, as a newer client might send it: tag 0x9A 0x06, empty message.
    const auto newer = clientMessage(4).SerializeAsString() + std::string("\x9a\x06\x00", 3);
    EXPECT_EQ(refused(decodeBinary(newer)).code, RejectCode::kUnsupported);
}

TEST(DecodeCommand, UnknownFields_AreIgnored) {
    v1::ClientMessage message = clientMessage();
    message.mutable_set_encoding()->set_quality(60);
    message.mutable_set_encoding()
        ->GetReflection()
        ->MutableUnknownFields(message.mutable_set_encoding())
        ->AddLengthDelimited(900, "later");
    message.GetReflection()->MutableUnknownFields(&message)->AddFixed64(901, 1);
    EXPECT_EQ(givenBy<uint32_t>(accepted<SetSettings>(decodeBinary(message)), "quality"), 60U);
}

TEST(DecodeCommand, EveryCommandOfTheSchema_IsKnown) {
    const auto& bodies = *v1::ClientMessage::descriptor()->FindOneofByName("body");
    for (int i = 0; i < bodies.field_count(); ++i) {
        v1::ClientMessage message = clientMessage();
        message.GetReflection()->MutableMessage(&message, bodies.field(i));
        const auto decoded = decodeBinary(message);
        EXPECT_TRUE(decoded || decoded.error().field != "body") << bodies.field(i)->name();
    }
}

TEST(DecodeCommand, EveryTruncation_NeitherCrashesNorInventsValues) {
    v1::ClientMessage message = cameraMessage();
    message.mutable_set_camera()->set_fov_deg(45);
    const std::string bytes = message.SerializeAsString();
    for (size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_FALSE(decodeBinary(bytes.substr(0, length))) << length;
    }
    EXPECT_TRUE(decodeBinary(bytes));
}

TEST(DecodeCommand, MalformedBytes_AreRefused) {
    for (const std::string_view bytes :
         {std::string_view("\xff"),
          std::string_view("\x08\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01"),
          std::string_view("\x0f\x01"),                     // wire type 7
          std::string_view("\xf2\x01\xff\xff\xff\xff\x0f"), // a length of 4 GiB
          std::string_view("\x0c"),                         // the end of no group
          std::string_view("\x00\x00", 2)}) {               // field 0
        EXPECT_EQ(refused(decodeBinary(bytes)).code, RejectCode::kMalformed);
    }
    // Invalid UTF-8 in a string field.
    EXPECT_FALSE(decodeBinary(std::string("\x08\x01\x52\x03\x1a\x01\xff", 7)));
}

TEST(DecodeCommand, DeepGroups_StopAtTheRecursionLimit) {
    // 30,000 nested starts of the unknown group 99.
    std::string bytes = clientMessage().SerializeAsString();
    for (int i = 0; i < 30'000; ++i) {
        bytes += "\x9b\x06";
    }
    EXPECT_EQ(refused(decodeBinary(bytes)).code, RejectCode::kMalformed);
}

} // namespace
} // namespace froxel::session
