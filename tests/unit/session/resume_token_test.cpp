#include "core/unguessable.h"
#include "session/resume_token.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace froxel::session {
namespace {

TEST(ResumeToken, Is64HexDigits_AndNoTwoAreAlike) {
    std::set<std::string> seen;
    for (int i = 0; i < 1000; ++i) {
        const std::string token = makeResumeToken();
        EXPECT_EQ(token.size(), 64U);
        EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos) << token;
        EXPECT_TRUE(seen.insert(token).second);
    }
}

// Every bit comes up, which a constant or truncated source would not do.
TEST(ResumeToken, EveryBit_IsSetInSomeAndClearInOthers) {
    const auto value = [](char digit) { return std::stoul(std::string(1, digit), nullptr, 16); };
    std::vector<unsigned long> any(64, 0);
    std::vector<unsigned long> all(64, 15);
    for (int i = 0; i < 200; ++i) {
        const std::string token = makeResumeToken();
        for (size_t digit = 0; digit < token.size(); ++digit) {
            any[digit] |= value(token[digit]);
            all[digit] &= value(token[digit]);
        }
    }
    for (size_t digit = 0; digit < 64; ++digit) {
        EXPECT_EQ(any[digit], 15U) << digit;
        EXPECT_EQ(all[digit], 0U) << digit;
    }
}

TEST(ResumeToken, Same_OnlyWhereEveryByteIs) {
    const std::string token = makeResumeToken();
    EXPECT_TRUE(sameSecret(token, token));
    EXPECT_TRUE(sameSecret("", ""));
    EXPECT_FALSE(sameSecret(token, token.substr(1)));
    EXPECT_FALSE(sameSecret(token, ""));
    for (size_t digit = 0; digit < token.size(); ++digit) {
        std::string other = token;
        other[digit] = other[digit] == '0' ? '1' : '0';
        EXPECT_FALSE(sameSecret(token, other)) << digit;
    }
}

} // namespace
} // namespace froxel::session
