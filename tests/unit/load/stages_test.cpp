#include "load/stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace froxel::load {
namespace {

using namespace std::chrono_literals;

std::vector<Stage> stages(const std::string& text) {
    return parseStages(text).value();
}

TEST(Stages, Lengths_WithEachUnit_AreSeconds) {
    EXPECT_EQ(stages("1m:10,0.5h:20,250ms:3,4:0"),
              (std::vector<Stage>{{60s, 10}, {1800s, 20}, {0.25s, 3}, {4s, 0}}));
    EXPECT_EQ(lengthOf(stages("1m:10,30s:0")), 90s);
    EXPECT_EQ(mostViewersOf(stages("1m:10,30s:50,1s:0")), 50U);
}

TEST(Stages, Faults_NameTheStageAndWhatWouldBeRight) {
    constexpr std::array kFaults = {std::pair{"", "stage ''"},
                                    std::pair{"10", "has no ':'"},
                                    std::pair{"1x:10", "stage '1x:10'"},
                                    std::pair{"1m:-1", "number of viewers from 0 to 10000"},
                                    std::pair{"1m:10,", "stage ''"},
                                    std::pair{"-1s:4", "length of 0 to 86400 s"},
                                    std::pair{"inf:4", "stage 'inf:4'"},
                                    std::pair{"nans:4", "stage 'nans:4'"},
                                    std::pair{"1s:10001", "10000"},
                                    std::pair{"0s:3", "take 0 s together"},
                                    std::pair{"5s:0", "let 0 viewers"},
                                    std::pair{"20h:1,20h:1", "144000 s"}};
    for (const auto& [text, words] : kFaults) {
        const auto parsed = parseStages(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_EQ(parsed.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(parsed.error().message.find(words), std::string::npos) << parsed.error().message;
    }
    std::string flood = "1ms:10000";
    for (int stage = 0; stage < 12; ++stage) {
        flood += ",1ms:0,1ms:10000";
    }
    EXPECT_FALSE(parseStages(flood)) << "more viewers in all than a run can hold";
}

TEST(Visits, Stages_ThatRiseStayAndFall_NewestLeavesFirst) {
    const auto visits = visitsOf(stages("4s:2,10s:2,2s:0"));
    EXPECT_EQ(visits, (std::vector<Visit>{{0s, 16s}, {2s, 15s}}));
}

TEST(Visits, AtOnce_InAStageOfNoLength) {
    const auto visits = visitsOf(stages("0s:3,5s:3,0s:1,5s:1"));
    EXPECT_EQ(visits, (std::vector<Visit>{{0s, {}}, {0s, 5s}, {0s, 5s}}));
}

TEST(Visits, OverARamp_AreEvenlyApart) {
    EXPECT_EQ(visitsOver(2s, 4), (std::vector<Visit>{{0s, {}}, {0.5s, {}}, {1s, {}}, {1.5s, {}}}));
}

TEST(DealOut, AnyFirstViewers_HaveTheSharesToWithinOne) {
    const std::vector<uint32_t> shares{5, 3, 2};
    const auto dealt = dealOut(shares, 1000);
    std::array<double, 3> counts{};
    for (size_t index = 0; index < dealt.size(); ++index) {
        ++counts.at(dealt[index]);
        for (size_t share = 0; share < shares.size(); ++share) {
            EXPECT_NEAR(counts.at(share), static_cast<double>(index + 1) * shares[share] / 10, 1)
                << index;
        }
    }
    EXPECT_EQ(dealOut({7}, 3), (std::vector<size_t>{0, 0, 0}));
}

} // namespace
} // namespace froxel::load
