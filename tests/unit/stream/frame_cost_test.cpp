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

// A view that rests keeps what one that moves draws.
TEST(FrameCost, IsThatOfMovingViews) {
    const auto device = std::make_shared<test::FakeDevice>();
    device->depth = 2;
    const auto source = test::makeFakeSource(device);
    settings::ViewSettings settings;
    settings.size = {64, 48};
    ASSERT_TRUE(measureFrameCost(*source, settings));
    const auto begun = device->begun();
    ASSERT_GE(begun.size(), 4U);
    for (size_t i = 2; i < begun.size(); ++i) {
        ASSERT_NE(begun[i].camera.eye_world, begun[i - 2].camera.eye_world) << i;
        const auto off = begun[i].camera.target_world() - settings.camera.target_world();
        ASSERT_LT(glm::length(off), 1e-9) << "it stays in view";
    }
}

TEST(FrameCost, PictureThatTakesTooLong_IsMeasuredSmaller) {
    const auto device = std::make_shared<test::FakeDevice>();
    device->slow_area_px = 64 * 48 / 3;
    const auto source = test::makeFakeSource(device);
    settings::ViewSettings settings;
    settings.size = {64, 48};
    EXPECT_TRUE(measureFrameCost(*source, settings));
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
