#include "still/unsent.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace froxel::still {
namespace {

SharedBytes zeros(size_t count) {
    return std::make_shared<const std::vector<std::byte>>(count);
}

TEST(Unsent, CountsBytes_UntilTheLastHolderLetsGo) {
    const auto unsent = std::make_shared<Unsent>();
    const session::Account one{"192.0.2.7"};
    const session::Account other{"198.51.100.1"};
    SharedBytes held = unsent->hold(zeros(10), one);
    SharedBytes shared = held;
    const SharedBytes others = unsent->hold(zeros(5), other);
    const SharedBytes nobodys = unsent->hold(zeros(3), std::nullopt);
    EXPECT_EQ(held->size(), 10U);
    EXPECT_EQ(unsent->of(one), 10U);
    EXPECT_EQ(unsent->of(other), 5U);
    EXPECT_EQ(unsent->all(), 18U);
    held.reset();
    EXPECT_EQ(unsent->of(one), 10U);
    shared.reset();
    EXPECT_EQ(unsent->of(one), 0U);
    EXPECT_EQ(unsent->all(), 8U);
}

TEST(Unsent, KeepsTheBytes_ThoughWhoMadeThemLetsGo) {
    auto unsent = std::make_shared<Unsent>();
    SharedBytes made = zeros(10);
    const std::weak_ptr<const std::vector<std::byte>> there = made;
    SharedBytes held = unsent->hold(std::exchange(made, nullptr), std::nullopt);
    unsent.reset();
    EXPECT_FALSE(there.expired());
    held.reset();
    EXPECT_TRUE(there.expired());
}

TEST(Unsent, WhoHasMost_GivesWayFirst_OnceItsClientHadTimeToRead) {
    using namespace std::chrono_literals;
    const auto unsent = std::make_shared<Unsent>();
    const session::Account greedy{"192.0.2.7"};
    const session::Account modest{"198.51.100.1"};
    std::vector<int> closed;
    std::vector<SharedBytes> held;
    const TimePoint now{};
    for (int i = 0; i < 3; ++i) {
        held.push_back(unsent->hold(zeros(10), greedy));
        Unsent::sending(
            held.back(), [&closed, i] { closed.push_back(i); }, now);
    }
    held.push_back(unsent->hold(zeros(8), modest));
    EXPECT_FALSE(unsent->shrinkTo(30, 8, now + 1s)) << "they may be on their way";
    EXPECT_FALSE(unsent->shrinkTo(30, 30, now + 2s)) << "it has no more than who asks";
    EXPECT_TRUE(unsent->shrinkTo(30, 8, now + 2s));
    EXPECT_EQ(closed, std::vector<int>{0});
    EXPECT_EQ(unsent->of(greedy), 20U) << "at once, though it is let go later";
    held.erase(held.begin());
    EXPECT_EQ(unsent->all(), 28U);
    held.clear();
    EXPECT_EQ(unsent->all(), 0U);
    EXPECT_EQ(closed.size(), 1U);
}

} // namespace
} // namespace froxel::still
