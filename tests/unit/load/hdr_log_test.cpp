// The log that these write is in samples.hlog; client-web/test/report/hdr_log.test.ts holds
// HdrHistogram's own JavaScript reader to that file.
#include "load/hdr_log.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace froxel::load {
namespace {

// 0.001 ms to beyond an hour: each bucket's width is met.
std::vector<double> samples() {
    std::vector<double> samples_ms{0, 0.0004, 4e6};
    for (int power = 0; power < 33; ++power) {
        for (int step = 0; step < 3; ++step) {
            samples_ms.push_back(std::ldexp(1 + step / 3.0, power) / 1000);
        }
    }
    return samples_ms;
}

std::string log() {
    return hdrLogHeader(1'790'000'000.5) +
           hdrLogLine("latency", Seconds(0), Seconds(2.5), samples()) +
           hdrLogLine("age", Seconds(0), Seconds(2.5), {}) +
           hdrLogLine("reaction", Seconds(1), Seconds(1), {12.345});
}

TEST(HdrLog, Log_IsTheOneThatAnotherReaderWasHeldTo) {
    std::ifstream file(test::repositoryPath("tests/unit/load/samples.hlog"));
    const std::string expected{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(log(), expected) << log();
}

TEST(HdrLog, Tag_WithoutASample_HasNoLine) {
    EXPECT_EQ(hdrLogLine("age", Seconds(0), Seconds(1), {}), "");
}

TEST(HdrLog, Line_HasTheTimesInSecondsAndTheMaximumInMilliseconds) {
    EXPECT_TRUE(hdrLogLine("reaction", Seconds(1), Seconds(2), {12.345, 3})
                    .starts_with("Tag=reaction,1.000,2.000,12.345,HISTF"));
}

} // namespace
} // namespace froxel::load
