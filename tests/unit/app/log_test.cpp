#include "app/log_limit.h"
#include "app/log_line.h"
#include "core/text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <gmock/gmock.h>

namespace froxel::app {
namespace {

using namespace std::chrono_literals;

TEST(LogLimit, Burst_IsAdmittedAndTheRestCounted) {
    LogLimit limit(3, Seconds(10));
    const TimePoint start{};
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(limit.admit("hello", start + i * 100ms), i < 3) << i;
    }
    EXPECT_TRUE(limit.takeLeftOut(start + 9s).empty()) << "the period is not over";
    const auto left_out = limit.takeLeftOut(start + 10s);
    ASSERT_EQ(left_out.size(), 1U);
    EXPECT_EQ(left_out[0].kind, "hello");
    EXPECT_EQ(left_out[0].count, 7U);
    EXPECT_TRUE(limit.takeLeftOut(start + 20s).empty()) << "told once";
}

TEST(LogLimit, PeriodOver_StartsAfreshAndKeepsTheCount) {
    LogLimit limit(1, Seconds(10));
    const TimePoint start{};
    EXPECT_TRUE(limit.admit("a", start));
    EXPECT_FALSE(limit.admit("a", start + 1s));
    EXPECT_TRUE(limit.admit("a", start + 10s));
    EXPECT_FALSE(limit.admit("a", start + 11s));
    const auto left_out = limit.takeLeftOut(start + 12s, true);
    ASSERT_EQ(left_out.size(), 1U);
    EXPECT_EQ(left_out[0].count, 2U);
}

TEST(LogLimit, Kinds_DoNotTakeFromEachOther) {
    LogLimit limit(1, Seconds(10));
    EXPECT_TRUE(limit.admit("a", TimePoint{}));
    EXPECT_TRUE(limit.admit("b", TimePoint{}));
    EXPECT_FALSE(limit.admit("a", TimePoint{}));
}

TEST(LogLine, Event_IsNamedByItsFirstField) {
    EXPECT_EQ(eventOf("event=hello session=3"), "hello");
    EXPECT_EQ(eventOf("event=hello"), "hello");
    EXPECT_EQ(eventOf("plan: no prepass"), "");
    EXPECT_EQ(eventOf("x event=hello"), "");
}

TEST(LogLine, Text_NewlinesAndEscapes_StayOnOneLine) {
    const std::string line = textLine("a\nevent=forged\r\x1b[31m\xc3\xa9");
    EXPECT_EQ(line, R"(a\x0aevent=forged\x0d\x1b[31m\xc3\xa9)");
    EXPECT_LE(textLine(std::string(1'000'000, '\n')).size(), 4U * 4096 + 3);
}

std::string event(const std::string& name) {
    return "event=hello session=3 client=" + logValue(name) + " peer=127.0.0.1:80 empty=\"\"";
}

TEST(LogLine, Json_HasTheFieldsAndTheirTypes) {
    const auto json = nlohmann::json::parse("{" + jsonFields(event("my page")) + "}");
    EXPECT_EQ(json["event"], "hello");
    EXPECT_EQ(json["session"], 3);
    EXPECT_EQ(json["client"], "my page");
    EXPECT_EQ(json["peer"], "127.0.0.1:80");
    EXPECT_EQ(json["empty"], "");
    EXPECT_EQ(json.size(), 5U);
    EXPECT_EQ(jsonFields("in \"words\""), R"("message":"in \"words\"")");
}

// What a client says can neither end its value nor add a field.
TEST(LogLine, Json_ClientText_ComesBackAsOneValue) {
    for (const std::string& hostile :
         {std::string("x\" code=1 session=9"), std::string("x\\"), std::string("\\\" a=b"),
          std::string("a=b"), std::string("{\"k\":1}"), std::string("\n{\"event\":\"forged\"}"),
          std::string(" "), std::string("12"), std::string("\"")}) {
        const auto json = nlohmann::json::parse("{" + jsonFields(event(hostile)) + "}");
        EXPECT_EQ(json["session"], 3) << hostile;
        EXPECT_EQ(json.size(), 5U) << hostile;
        const auto& client = json["client"];
        EXPECT_EQ(client.is_string() ? client.get<std::string>() : client.dump(),
                  printable(hostile))
            << hostile;
    }
}

TEST(LogLine, Json_AnyBytes_AreOneLineOfJson) {
    uint32_t state = 1;
    for (int i = 0; i < 2000; ++i) {
        std::string payload = i % 2 == 0 ? "event=x a=" : "";
        for (int k = 0; k < 40; ++k) {
            state = state * 1664525U + 1013904223U;
            payload += static_cast<char>(state >> 24U);
        }
        const std::string fields = jsonFields(payload);
        EXPECT_EQ(fields.find('\n'), std::string::npos);
        EXPECT_TRUE(nlohmann::json::accept("{" + fields + "}")) << fields;
    }
}

} // namespace
} // namespace froxel::app
