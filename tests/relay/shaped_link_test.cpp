#include "relay/shaped_link.h"

#include <gtest/gtest.h>

#include <numeric>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<uint8_t>;

const TimePoint kStart = TimePoint{} + 1h;

Bytes counted(size_t size, uint8_t first = 0) {
    Bytes bytes(size);
    std::iota(bytes.begin(), bytes.end(), first);
    return bytes;
}

TEST(ShapedLink, Delay_HoldsEachByteForThatLong) {
    ShapedLink link({TokenBucket::kUnlimited, 20ms, 10'000}, kStart);
    link.push(counted(100), kStart);
    link.push(counted(50, 100), kStart + 5ms);
    EXPECT_EQ(link.nextDue(kStart), kStart + 20ms);
    EXPECT_TRUE(link.take(kStart + 20ms - 1us).empty());
    EXPECT_EQ(link.take(kStart + 20ms), counted(100));
    EXPECT_EQ(link.take(kStart + 25ms), counted(50, 100));
    EXPECT_TRUE(link.empty());
    EXPECT_FALSE(link.nextDue(kStart + 25ms));
}

TEST(ShapedLink, Queue_Full_TakesNoMoreUntilTheRateEmptiesIt) {
    ShapedLink link({15'000, 0ms, 6'000}, kStart);
    link.push(counted(6'000), kStart); // 1,500 pass at once
    EXPECT_EQ(link.room(), 1'500U);
    link.push(counted(1'500), kStart);
    EXPECT_EQ(link.room(), 0U);
    EXPECT_EQ(link.take(kStart).size(), 1'500U);
    EXPECT_EQ(link.room(), 0U);
    EXPECT_EQ(link.take(kStart + 100ms).size(), 1'500U);
    EXPECT_EQ(link.room(), 1'500U);
}

TEST(ShapedLink, Rate_ByItsOwnTimes_DeliversAllInOrder) {
    ShapedLink link({100'000, 30ms, 64'000}, kStart);
    const Bytes sent = counted(50'000);
    link.push(sent, kStart);
    Bytes received;
    TimePoint now = kStart;
    while (const auto due = link.nextDue(now)) {
        now = *due;
        const Bytes some = link.take(now);
        received.insert(received.end(), some.begin(), some.end());
    }
    EXPECT_EQ(received, sent);
    const double seconds = Seconds(now - kStart).count();
    EXPECT_NEAR(seconds, 0.5 + 0.03, 0.02); // less a burst
}

TEST(ShapedLink, RateChanged_WhileBytesWait_HoldsAtOnce) {
    ShapedLink link({0, 0ms, 64'000}, kStart);
    link.push(counted(3'000), kStart);
    EXPECT_EQ(link.take(kStart + 1s).size(), 1'500U); // what the bucket was full of
    link.setRate(15'000, kStart + 1s);
    EXPECT_EQ(link.nextDue(kStart + 1s), kStart + 1s + 100ms);
    EXPECT_EQ(link.take(kStart + 1s + 100ms).size(), 1'500U);
    EXPECT_TRUE(link.empty());
}

TEST(ShapedLink, UnlimitedAndSlow_HoldsABoundedAmount) {
    ShapedLink link({TokenBucket::kUnlimited, 1h, 64'000}, kStart);
    const Bytes piece = counted(64'000);
    size_t held = 0;
    while (link.room() > 0) {
        const size_t size = std::min(link.room(), piece.size());
        link.push({piece.data(), size}, kStart);
        held += size;
        ASSERT_LE(held, ShapedLink::kMaxUnderWayBytes + 200'000);
    }
    EXPECT_GE(held, ShapedLink::kMaxUnderWayBytes);
}

} // namespace
} // namespace froxel::test
