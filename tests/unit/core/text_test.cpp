#include "core/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace froxel {
namespace {

TEST(NumberText, Doubles_ReadBackShortest) {
    EXPECT_EQ(numberText(0.1), "0.1");
    EXPECT_EQ(numberText(1e-7), "1e-07");
    EXPECT_EQ(numberText(1e-6), "0.000001");
    EXPECT_EQ(numberText(0.0), "0");
    EXPECT_EQ(numberText(-1.2345678901234567e-6), "-0.0000012345678901234567");
    EXPECT_EQ(numberText(-1e7), "-10000000");
    EXPECT_EQ(numberText(999'999'999'999'999.0), "999999999999999");
    EXPECT_EQ(numberText(1e300), "1e+300");
    EXPECT_EQ(numberText(0.1F), "0.1");
    EXPECT_EQ(numberText(std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(numberText(-std::numeric_limits<double>::infinity()), "-inf");
    const double longest = -1.2345678901234567e-300;
    EXPECT_EQ(std::stod(numberText(longest)), longest);
}

TEST(NumberText, Integers_KeepEveryDigit) {
    EXPECT_EQ(numberText(std::numeric_limits<uint64_t>::max()), "18446744073709551615");
    EXPECT_EQ(numberText(std::numeric_limits<int64_t>::min()), "-9223372036854775808");
}

TEST(Printable, ControlAndNonAsciiBytes_AreEscaped) {
    EXPECT_EQ(printable("plain text"), "plain text");
    EXPECT_EQ(printable("a\nb\x1b[31m"), "a\\x0ab\\x1b[31m");
    EXPECT_EQ(printable("\xff\x7f"), "\\xff\\x7f");
    EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
}

TEST(Printable, LongText_IsCutAndSaysSo) {
    EXPECT_EQ(printable("12345", 5), "12345");
    EXPECT_EQ(printable("123456", 5), "12345...");
}

TEST(LogValue, PlainWord_StaysAsItIs) {
    EXPECT_EQ(logValue("127.0.0.1:80"), "127.0.0.1:80");
}

TEST(LogValue, WhatWouldEndAValue_IsQuotedOrEscaped) {
    EXPECT_EQ(logValue(""), R"("")");
    EXPECT_EQ(logValue("two words"), R"("two words")");
    EXPECT_EQ(logValue("a=b"), R"("a=b")");
    EXPECT_EQ(logValue(R"(say "hi")"), R"("say \"hi\"")");
    EXPECT_EQ(logValue(R"(x" code=1 y="\)"), R"("x\" code=1 y=\"\\")");
    EXPECT_EQ(logValue("a\nevent=forged"), R"("a\\x0aevent=forged")");
    EXPECT_EQ(logValue("123456", 5), "12345...");
}

} // namespace
} // namespace froxel
