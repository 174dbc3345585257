#include "load/script_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

namespace froxel::load {
namespace {

using namespace std::chrono_literals;

Result<Recording> read(const std::string& text) {
    std::istringstream lines(text);
    return readScript(lines, "some.jsonl");
}

std::string refusal(const std::string& text) {
    const auto script = read(text);
    EXPECT_FALSE(script) << text;
    return script ? "" : script.error().message;
}

TEST(ScriptFile, Lines_WithTimes_AreStepsInOrder) {
    const auto steps = read(R"({"setLights": {"count": 500, "animate": false}}
{"at_ms": 250.5, "seq": "77", "clientTimeUs": "12", "setRenderer": {"renderer": "RENDERER_NAIVE"}}
{"ping": {}}
)")
                           .value();
    ASSERT_EQ(steps->size(), 3U);
    EXPECT_EQ((*steps)[0].at, 0ms);
    EXPECT_EQ((*steps)[0].message.set_lights().count(), 500U);
    EXPECT_EQ((*steps)[1].at, 250'500us);
    EXPECT_EQ((*steps)[1].message.set_renderer().renderer(), v1::RENDERER_NAIVE);
    EXPECT_EQ((*steps)[2].at, 250'500us) << "the line's before";
    EXPECT_TRUE((*steps)[2].message.has_ping());
}

TEST(ScriptFile, Empty_IsNoSteps) {
    EXPECT_TRUE(read("").value()->empty());
}

TEST(ScriptFile, BadLine_IsNamedWithFileNumberAndReason) {
    const std::string good = "{\"ping\": {}}\n";
    const struct {
        const char* line;
        const char* reason;
    } cases[] = {
        {"", "not JSON"},
        {"{\"ping\": {}", "not JSON"},
        {"[]", "object"},
        {"{}", "command"},
        {"{\"at_ms\": 5}", "command"},
        {"{\"setSize\": {\"width\": 640, \"height\": 360, \"depth\": 3}}", "depth"},
        {"{\"setSise\": {}}", "setSise"},
        {"{\"atMs\": 5, \"ping\": {}}", "atMs"},
        {"{\"setSize\": {\"width\": 5, \"height\": 360}}", "width is 5; it must be from 16"},
        {"{\"setExposure\": {\"exposure\": \"NaN\"}}", "exposure is nan"},
        {"{\"setRenderer\": {\"renderer\": \"RENDERER_BEST\"}}", "RENDERER_BEST"},
        {"{\"ping\": {}, \"ping\": {}}", "twice"},
        {"{\"at_ms\": -1, \"ping\": {}}", "at_ms is -1"},
        {"{\"at_ms\": \"5\", \"ping\": {}}", "at_ms is \"5\""},
        {"{\"at_ms\": 1e300, \"ping\": {}}", "at_ms is 1e+300"},
        {"{\"hello\": {\"protocolMajor\": 1}}", "hello is said by the viewer"},
        {"{\"ack\": {\"frameId\": \"1\"}}", "ack is said by the viewer"},
    };
    for (const auto& [line, reason] : cases) {
        const std::string text = refusal(good + line + "\n");
        EXPECT_EQ(text.find("some.jsonl:2: "), 0U) << text;
        EXPECT_NE(text.find(reason), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
}

TEST(ScriptFile, Time_BeforeTheLineBefore_IsRefused) {
    const std::string text =
        refusal("{\"at_ms\": 9, \"ping\": {}}\n{\"at_ms\": 8, \"ping\": {}}\n");
    EXPECT_NE(text.find("at_ms is 8"), std::string::npos) << text;
}

TEST(ScriptFile, Line_LongerThanAMessage_IsRefused) {
    EXPECT_NE(refusal(std::string(70'000, ' ')).find("65536"), std::string::npos);
}

TEST(ScriptFile, File_Absent_IsNamed) {
    const auto script = readScriptFile("/no/such.jsonl");
    ASSERT_FALSE(script);
    EXPECT_EQ(script.error().code, ErrorCode::kIo);
    EXPECT_NE(script.error().message.find("/no/such.jsonl"), std::string::npos);
}

} // namespace
} // namespace froxel::load
