#include "stream/frame_cost.h"
#include "support/fake_frame_source.h"

#include <gtest/gtest.h>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

TEST(FrameCost, IsADevicesTimeForAFrame_AndLeavesNothing) {
    const auto device = std::make_shared<test::FakeDevice>();
    device->frame_time = 5ms;
    const auto source = test::makeFakeSource(device);
    settings::ViewSettings settings;
    settings.size = {64, 48};
    const auto cost = measureFrameCost(*source, settings);
    ASSERT_TRUE(cost);
    EXPECT_GE(*cost, 5ms);
    EXPECT_EQ(device->live_views, 0);
    EXPECT_EQ(device->live_leases, 0);
}

// What the device does of one while it does nothing of the next is no part of it.
TEST(FrameCost, FramesUnderWayTogether_AreCountedOnce) {
    const auto device = std::make_shared<test::FakeDevice>();
    device->depth = 2;
    device->piece_count = 2;
    device->frame_time = 20ms;
    const auto source = test::makeFakeSource(device);
    settings::ViewSettings settings;
    settings.size = {64, 48};
    const auto cost = measureFrameCost(*source, settings);
    ASSERT_TRUE(cost);
    EXPECT_GE(*cost, 20ms);
    EXPECT_EQ(device->live_views, 0);
    EXPECT_EQ(device->live_leases, 0);
}

TEST(FrameCost, BrokenOff_LeavesNothingAndHasNoCost) {
    const auto device = std::make_shared<test::FakeDevice>();
    device->depth = 2;
    const auto source = test::makeFakeSource(device);
    settings::ViewSettings settings;
    settings.size = {64, 48};
    int asked = 0;
    const auto cost = measureFrameCost(*source, settings, [&] { return ++asked < 5; });
    ASSERT_FALSE(cost);
    EXPECT_EQ(cost.error().code, ErrorCode::kCapacity);
    EXPECT_EQ(device->live_views, 0);
    EXPECT_EQ(device->live_leases, 0);
}

TEST(FrameCost, PictureThatCannotBeMade_SaysWhy) {
    const auto device = std::make_shared<test::FakeDevice>();
    device->max_lights = 10;
    const auto source = test::makeFakeSource(device);
    settings::ViewSettings settings;
    settings.size = {64, 48};
    settings.lights.count = 11;
    const auto cost = measureFrameCost(*source, settings);
    ASSERT_FALSE(cost);
    EXPECT_EQ(cost.error().code, ErrorCode::kCapacity);
}

} // namespace
} // namespace froxel::stream
