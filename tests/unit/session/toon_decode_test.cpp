// Ramps of the toon renderers.
#include "unit/session/messages.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace froxel::session {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void addPoint(v1::ToonRamp& ramp, double x, double y, double slope = 0) {
    v1::ToonRamp::Point& point = *ramp.add_points();
    point.set_x(x);
    point.set_y(y);
    point.set_slope(slope);
}

TEST(DecodeCommand, SetToon_TakesAscendingRamps) {
    v1::ClientMessage message = clientMessage();
    v1::ToonRamp& ramp = *message.mutable_set_toon()->mutable_compute();
    addPoint(ramp, 0, 0.25, 2);
    addPoint(ramp, 1, 1, -20);
    const auto command = accepted<SetToon>(decodeBinary(message));
    EXPECT_FALSE(command.fragment);
    EXPECT_EQ(command.compute->count, 2U);
    EXPECT_EQ(command.compute->points[0], (settings::ToonRamp::Point{0, 0.25F, 2}));
    EXPECT_EQ(command.compute->points[1], (settings::ToonRamp::Point{1, 1, -20}));
    EXPECT_EQ(command.compute->points[2], settings::ToonRamp::Point{});
}

TEST(DecodeCommand, SetToon_PointCountAndOrder_AreChecked) {
    const auto fault = [](std::initializer_list<double> xs) {
        v1::ClientMessage message = clientMessage();
        v1::ToonRamp& ramp = *message.mutable_set_toon()->mutable_fragment();
        for (const double x : xs) {
            addPoint(ramp, x, 0.5);
        }
        return refused(decodeBinary(message)).message;
    };
    EXPECT_EQ(fault({}), "toon_fragment has 0 points; it must have 2 to 8");
    EXPECT_EQ(fault({0}), "toon_fragment has 1 points; it must have 2 to 8");
    EXPECT_EQ(fault({0, .1, .2, .3, .4, .5, .6, .7, .8}),
              "toon_fragment has 9 points; it must have 2 to 8");
    EXPECT_EQ(fault({0, 0.5, 0.5}),
              "toon_fragment.points[2].x is 0.5; it must be above 0.5, the one before it");
    // Apart in double, one float: the shader would divide by their difference.
    EXPECT_THAT(fault({0, 0.5, 0.5 + 1e-12}), HasSubstr("points[2].x"));
    EXPECT_THAT(fault({0, 1.5}), HasSubstr("points[1].x is 1.5; it must be from 0 to 1"));
    EXPECT_THAT(fault({0, kNan}), HasSubstr("points[1].x is nan"));
}

TEST(DecodeCommand, SetToonOutline_IsTakenWithoutARamp) {
    v1::ClientMessage message = clientMessage();
    message.mutable_set_toon()->set_outline_strength(0.75);
    const auto command = accepted<SetToon>(decodeBinary(message));
    ASSERT_EQ(command.changes.size(), 1U);
    EXPECT_EQ(command.changes[0].value, settings::SettingValue(0.75));
    EXPECT_FALSE(command.fragment || command.compute);
}

} // namespace
} // namespace froxel::session
