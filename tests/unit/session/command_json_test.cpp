// Text messages: canonical JSON, what it may leave out, and what people and attackers type.
#include "support/settings.h"
#include "unit/session/messages.h"

#include <gmock/gmock.h>

namespace froxel::session {
namespace {

using test::givenBy;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CommandJson, BothSpellingsOfAName_AreTaken) {
    EXPECT_EQ(givenBy<double>(accepted<SetLights>(decodeBody(R"("setLights":{"radiusM":2.5})")),
                              "light_radius"),
              2.5);
    EXPECT_EQ(givenBy<double>(accepted<SetLights>(decodeBody(R"("set_lights":{"radius_m":2.5})")),
                              "light_radius"),
              2.5);
}

TEST(CommandJson, SixtyFourBitIntegers_AsStringOrNumber) {
    const auto text = decodeText(R"({"seq":"18446744073709551615","clientTimeUs":7,"ping":{}})");
    ASSERT_TRUE(text);
    EXPECT_EQ(text->stamp, (CommandStamp{18446744073709551615ULL, 7}));
    const auto number = decodeText(R"({"seq":18446744073709551615,"ping":{}})");
    ASSERT_TRUE(number) << number.error().message;
    EXPECT_EQ(number->stamp.seq, 18446744073709551615ULL);
}

TEST(CommandJson, NumbersAsStrings_AreNumbersOrNamed) {
    EXPECT_EQ(givenBy<double>(accepted<SetLights>(decodeBody(R"("setLights":{"radiusM":"2.5"})")),
                              "light_radius"),
              2.5);
    EXPECT_EQ(
        accepted<SetSize>(decodeBody(R"("setSize":{"width":"64","height":6.4e1})")).size.height_px,
        64U);
    for (const char* width :
         {R"("4294967296")", R"("-1")", R"("0x40")", R"(" 64")", R"("64.0")", R"("")"}) {
        EXPECT_THAT(
            refused(decodeBody(R"("setSize":{"height":64,"width":)" + std::string(width) + "}"))
                .message,
            AllOf(HasSubstr(width), HasSubstr("a whole number from 0 to 4294967295")));
    }
    for (const char* radius : {"inf", "nan", "1e400", "+1", "1m"}) {
        EXPECT_EQ(refused(decodeBody(R"("setLights":{"radiusM":")" + std::string(radius) + "\"}"))
                      .message,
                  "radius_m is \"" + std::string(radius) + "\"; it must be a number");
    }
    EXPECT_EQ(refused(decodeText(R"({"seq":18446744073709551616,"ping":{}})")).code,
              RejectCode::kOutOfRange);
}

TEST(CommandJson, EnumsByNameOrNumber) {
    const auto given = [](const char* body) {
        return givenBy<settings::Renderer>(accepted<SetSettings>(decodeBody(body)), "renderer");
    };
    EXPECT_EQ(given(R"("setRenderer":{"renderer":"RENDERER_TOON_COMPUTE"})"),
              settings::Renderer::kToonCompute);
    EXPECT_EQ(given(R"("setRenderer":{"renderer":2})"), settings::Renderer::kForwardPlus);
}

TEST(CommandJson, UnknownEnumName_IsUnsupportedEvenWhereOptional) {
    const Rejection rejection = refused(
        decodeText(R"({"seq":"8","setExposure":{"exposure":2,"toneMap":"TONE_MAP_ACES\n"}})"));
    EXPECT_EQ(rejection.code, RejectCode::kUnsupported);
    EXPECT_EQ(rejection.field, "tone_map");
    EXPECT_EQ(rejection.ref_seq, 8U);
    EXPECT_EQ(rejection.message, "tone_map has no value \"TONE_MAP_ACES\\x0a\"");
    EXPECT_EQ(refused(decodeBody(R"("setRenderer":{"renderer":77})")).code,
              RejectCode::kUnsupported);
}

TEST(CommandJson, UnknownFields_AreIgnoredAtAnyDepth) {
    EXPECT_EQ(
        accepted<SetGrid>(
            decodeBody(R"("x":[{"y":null}],"setGrid":{"new":1,"grid":{"x":1,"y":2,"z":3,"w":4}})"))
            .size,
        (settings::GridSize{1, 2, 3}));
}

TEST(CommandJson, UnknownCommand_IsUnsupported) {
    const Rejection rejection = refused(decodeText(R"({"seq":3,"setRain":{"density":1}})"));
    EXPECT_EQ(rejection.code, RejectCode::kUnsupported);
    EXPECT_EQ(rejection.ref_seq, 3U);
}

TEST(CommandJson, TwoCommands_AreMalformed) {
    const Rejection rejection = refused(decodeBody(R"("ping":{},"ack":{"frameId":1})"));
    EXPECT_EQ(rejection.code, RejectCode::kMalformed);
    EXPECT_EQ(rejection.ref_seq, 1U);
    EXPECT_EQ(rejection.message, "ack and ping are both there");
    EXPECT_EQ(
        refused(decodeBody(R"("setSize":{"width":64,"height":64},"set_size":{"width":1})")).message,
        "set_size is there twice");
    EXPECT_EQ(refused(decodeBody(R"("setLights":{"radiusM":1,"radius_m":2})")).message,
              "radius_m is there twice");
}

TEST(CommandJson, NanAndInfinityStrings_AreOutOfRange) {
    for (const char* bad : {"NaN", "Infinity", "-Infinity"}) {
        const Rejection rejection =
            refused(decodeBody(R"("setLights":{"radiusM":")" + std::string(bad) + "\"}"));
        EXPECT_EQ(rejection.code, RejectCode::kOutOfRange) << bad;
        EXPECT_EQ(rejection.field, "light_radius");
    }
}

TEST(CommandJson, BareNan_IsNotJson) {
    EXPECT_EQ(refused(decodeBody(R"("setLights":{"radiusM":NaN})")).code, RejectCode::kMalformed);
}

TEST(CommandJson, HugeNumbers_AreOutOfRange) {
    EXPECT_EQ(refused(decodeBody(R"("setLights":{"radiusM":1e400})")).code,
              RejectCode::kOutOfRange);
    EXPECT_EQ(refused(decodeBody(R"("setLights":{"radiusM":1e300})")).field, "light_radius");
    EXPECT_EQ(refused(decodeBody(R"("setLights":{"count":1)" + std::string(400, '0') + "}")).code,
              RejectCode::kOutOfRange);
}

TEST(CommandJson, IntegersThatAreNone_NameFieldAndValue) {
    EXPECT_EQ(refused(decodeBody(R"("setSize":{"width":-5,"height":64})")).message,
              "width is -5; it must be a whole number from 0 to 4294967295");
    EXPECT_EQ(refused(decodeBody(R"("setSize":{"width":64.5,"height":64})")).message,
              "width is 64.5; it must be a whole number from 0 to 4294967295");
    EXPECT_EQ(refused(decodeBody(R"("setSize":{"width":4294967296,"height":64})")).code,
              RejectCode::kOutOfRange);
    EXPECT_EQ(refused(decodeText(R"({"seq":-1,"ping":{}})")).code, RejectCode::kOutOfRange);
    EXPECT_EQ(refused(decodeText(R"({"seq":1e30,"ping":{}})")).code, RejectCode::kOutOfRange);
}

TEST(CommandJson, WrongTypes_AreMalformedAndNamed) {
    EXPECT_THAT(refused(decodeBody(R"("setSize":{"width":[1],"height":64})")).message,
                HasSubstr("width is array; it must be a single value"));
    EXPECT_THAT(refused(decodeBody(R"("setSize":{"width":{"a":1},"height":64})")).message,
                HasSubstr("width is object"));
    EXPECT_THAT(refused(decodeBody(R"("setSize":3)")).message, HasSubstr("must be an object"));
    EXPECT_THAT(refused(decodeBody(R"("setToon":{"compute":{"points":{}}})")).message,
                HasSubstr("points is object; it must be an array"));
    EXPECT_THAT(refused(decodeBody(R"("setToon":{"compute":{"points":[1]}})")).message,
                HasSubstr("Point is number; it must be an object"));
    for (const char* body :
         {R"("setSize":{"width":"wide","height":64})", R"("setSize":{"width":true,"height":64})",
          R"("setLights":{"animate":1})", R"("setLights":{"radiusM":"two"})",
          R"("selectSceneCamera":{"name":5})"}) {
        const Rejection rejection = refused(decodeBody(body));
        EXPECT_EQ(rejection.code, RejectCode::kMalformed) << body;
        EXPECT_EQ(rejection.ref_seq, 1U) << body;
    }
}

TEST(CommandJson, NotJson_IsMalformedWithAPlace) {
    for (const char* text : {"", "{", "nonsense", "{\"seq\":1,}", "{'seq':1}", "{\"seq\":1}x",
                             "{\"seq\":01}", "/*c*/{}", "\"\\ud800\"", "\xff\xfe"}) {
        const Rejection rejection = refused(decodeText(text));
        EXPECT_EQ(rejection.code, RejectCode::kMalformed) << text;
        EXPECT_THAT(rejection.message, HasSubstr("not JSON: error at byte ")) << text;
    }
}

TEST(CommandJson, OtherThanAnObject_IsMalformed) {
    for (const char* text : {"[]", "1", "null", "\"seq\"", "[{\"seq\":1}]"}) {
        EXPECT_EQ(refused(decodeText(text)).code, RejectCode::kMalformed) << text;
    }
}

TEST(CommandJson, RepeatedKeys_AreMalformed) {
    const Rejection rejection =
        refused(decodeBody(R"("setSize":{"width":64,"height":64,"width":128})"));
    EXPECT_EQ(rejection.code, RejectCode::kMalformed);
    EXPECT_EQ(rejection.field, "width");
    EXPECT_TRUE(decodeBody(R"("setGrid":{"grid":{"x":1,"y":1,"z":1}},"other":{"x":1})"));
}

TEST(CommandJson, DeepNesting_IsRefusedWithoutRecursion) {
    for (const auto& [open, close] : {std::pair{"[", "]"}, {"{\"a\":", "}"}}) {
        std::string nested;
        for (int i = 0; i < 12'000; ++i) {
            nested += open;
        }
        nested += "1";
        for (int i = 0; i < 12'000; ++i) {
            nested += close;
        }
        const Rejection rejection = refused(decodeBody("\"deep\":" + nested));
        EXPECT_EQ(rejection.code, RejectCode::kMalformed);
        EXPECT_EQ(rejection.message, "JSON nested deeper than 16");
    }
}

TEST(CommandJson, ClientText_ReachesMessagesEscapedAndCut) {
    for (const std::string& text :
         {"\\u001b[31m" + std::string(5000, 'w'), std::string(5000, '\x7F')}) {
        const Rejection rejection = refused(decodeBody("\"setSize\":{\"width\":\"" + text + "\"}"));
        EXPECT_LT(rejection.message.size(), 500U);
        for (const char character : rejection.message) {
            EXPECT_TRUE(character >= 0x20 && character < 0x7F);
        }
    }
}

TEST(CommandJson, Null_IsAbsent) {
    EXPECT_EQ(refused(decodeBody(R"("setCamera":{"eye":null,"target":{"x":1}})")).message,
              "eye is missing");
    EXPECT_TRUE(accepted<SetLights>(decodeBody(R"("setLights":{"count":null})")).changes.empty());
}

} // namespace
} // namespace froxel::session
