#include "relay/token_bucket.h"

#include <gtest/gtest.h>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;

const TimePoint kStart = TimePoint{} + 1h;

// Bytes that pass in pieces of 1000 within `time`, asking as often as the bucket says.
size_t passed(TokenBucket& bucket, TimePoint from, Clock::duration time) {
    size_t bytes = 0;
    for (TimePoint now = from; now <= from + time; now = bucket.whenReady(1000, now)) {
        while (bucket.take(1000, now)) {
            bytes += 1000;
        }
    }
    return bytes;
}

TEST(TokenBucket, Rate_OverASecond_IsHeldWithinABurst) {
    TokenBucket bucket(500'000, kStart);
    const size_t bytes = passed(bucket, kStart, 1s);
    EXPECT_GE(bytes, 500'000U - 1000);
    EXPECT_LE(bytes, 500'000U + 5'000 + 1000); // 10 ms of it
}

TEST(TokenBucket, Burst_AfterAPause_IsNoLarger) {
    TokenBucket bucket(500'000, kStart);
    size_t at_once = 0;
    while (bucket.take(1000, kStart + 1h)) {
        at_once += 1000;
    }
    EXPECT_EQ(at_once, 5'000U);
}

TEST(TokenBucket, WhenReady_IsWhenTakeDoes) {
    TokenBucket bucket(1000, kStart);
    ASSERT_TRUE(bucket.take(1500, kStart));
    const TimePoint ready = bucket.whenReady(500, kStart);
    EXPECT_EQ(ready, kStart + 500ms);
    EXPECT_FALSE(bucket.take(500, ready - 1us));
    EXPECT_TRUE(bucket.take(500, ready));
}

TEST(TokenBucket, RateChanged_HoldsFromThenOn) {
    TokenBucket bucket(500'000, kStart);
    static_cast<void>(passed(bucket, kStart, 1s));
    bucket.setRate(50'000, kStart + 1s);
    const size_t slow = passed(bucket, kStart + 1s, 1s);
    EXPECT_GE(slow, 50'000U - 1500);
    EXPECT_LE(slow, 50'000U + 1500);
    bucket.setRate(500'000, kStart + 2s);
    EXPECT_GE(passed(bucket, kStart + 2s, 1s), 500'000U - 6'000);
}

TEST(TokenBucket, Unlimited_NeverWaits) {
    TokenBucket bucket(TokenBucket::kUnlimited, kStart);
    for (int index = 0; index < 1000; ++index) {
        EXPECT_TRUE(bucket.take(1500, kStart));
    }
    EXPECT_EQ(bucket.whenReady(1500, kStart), kStart);
}

TEST(TokenBucket, RateZero_LetsNothingPass) {
    TokenBucket bucket(0, kStart);
    ASSERT_TRUE(bucket.take(1500, kStart)); // what it was full of
    EXPECT_FALSE(bucket.take(1, kStart + 1h));
    EXPECT_GE(bucket.whenReady(1, kStart + 1h), kStart + 24h);
}

TEST(TokenBucket, Clock_GoingBack_GivesNoTokens) {
    TokenBucket bucket(1000, kStart);
    ASSERT_TRUE(bucket.take(1500, kStart));
    EXPECT_FALSE(bucket.take(1, kStart - 1h));
    EXPECT_FALSE(bucket.take(100, kStart + 50ms));
    EXPECT_TRUE(bucket.take(100, kStart + 100ms));
}

} // namespace
} // namespace froxel::test
