#include "net/long_work.h"

#include <gtest/gtest.h>

#include <new>
#include <optional>

namespace froxel::net {
namespace {

TEST(LongWork, Exception_CostsThatWorkAlone) {
    boost::asio::io_context home;
    // Between the two nothing is under way, and a context without work stops.
    auto both = boost::asio::make_work_guard(home);
    std::optional<int> made;
    LongWork long_work(1);
    long_work.run(
        home.get_executor(), []() -> int { throw std::bad_alloc(); },
        [&](int, Seconds) { made = 1; });
    long_work.run(
        home.get_executor(), [] { return 2; }, [&](int result, Seconds) { made = result; });
    both.reset();
    home.run(); // until neither has anything to bring home
    EXPECT_EQ(made, 2);
}

} // namespace
} // namespace froxel::net
