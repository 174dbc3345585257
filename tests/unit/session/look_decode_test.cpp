// Messages that say how the lit picture looks.
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
    EXPECT_EQ(command.compute->points[0], (view::ToonRamp::Point{0, 0.25F, 2}));
    EXPECT_EQ(command.compute->points[1], (view::ToonRamp::Point{1, 1, -20}));
    EXPECT_EQ(command.compute->points[2], view::ToonRamp::Point{});
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

TEST(DecodeCommand, SetPost_IsTakenInPartsAndNotEmpty) {
    v1::ClientMessage message = clientMessage();
    v1::SetPost& set = *message.mutable_set_post();
    EXPECT_EQ(refused(decodeBinary(message)).message, "bloom is missing");
    set.set_antialiasing(v1::ANTIALIASING_SSAA4);
    auto command = accepted<SetPost>(decodeBinary(message));
    EXPECT_EQ(command.antialiasing, view::Antialiasing::kSsaa4);
    EXPECT_FALSE(command.bloom || command.bloom_threshold || command.bloom_knee ||
                 command.bloom_strength || command.bloom_radius);
    set.set_bloom(v1::BLOOM_KIND_SEPARABLE);
    set.set_bloom_threshold(0);
    set.set_bloom_knee(1);
    set.set_bloom_strength(0.5);
    set.set_bloom_radius(0.01);
    command = accepted<SetPost>(decodeBinary(message));
    EXPECT_EQ(command.bloom, view::BloomKind::kSeparable);
    EXPECT_EQ(command.bloom_threshold, 0);
    EXPECT_EQ(command.bloom_knee, 1);
    EXPECT_EQ(command.bloom_strength, 0.5);
    EXPECT_EQ(command.bloom_radius, 0.01);
}

TEST(DecodeCommand, SetTransparency_IsTakenInPartsAndNotEmpty) {
    v1::ClientMessage message = clientMessage();
    v1::SetTransparency& set = *message.mutable_set_transparency();
    EXPECT_EQ(refused(decodeBinary(message)).message, "transparency is missing");
    set.set_peel_layers(16);
    auto command = accepted<SetTransparency>(decodeBinary(message));
    EXPECT_FALSE(command.transparency);
    EXPECT_EQ(command.peel_layers, 16U);
    set.set_transparency(v1::TRANSPARENCY_WEIGHTED);
    command = accepted<SetTransparency>(decodeBinary(message));
    EXPECT_EQ(command.transparency, view::Transparency::kWeighted);
}

TEST(DecodeCommand, SetFog_IsTakenInPartsAndNotEmpty) {
    v1::ClientMessage message = clientMessage();
    message.mutable_set_fog();
    EXPECT_EQ(refused(decodeBinary(message)).message, "fog is missing");
    v1::Fog& fog = *message.mutable_set_fog()->mutable_fog();
    EXPECT_EQ(refused(decodeBinary(message)).message, "fog is missing");
    fog.set_density(0); // given, and off
    auto command = accepted<SetFog>(decodeBinary(message));
    EXPECT_EQ(command.density, 0);
    EXPECT_FALSE(command.height_falloff || command.base_height_m || command.anisotropy ||
                 command.albedo || command.tile_px || command.slice_count || command.half_rate ||
                 command.noise);
    fog.set_height_falloff(0.5);
    fog.set_base_height(-2);
    fog.set_anisotropy(0.75);
    fog.mutable_albedo()->set_x(1);
    fog.mutable_albedo()->set_z(0.5);
    fog.set_tile(8);
    fog.set_slices(128);
    fog.set_half_rate(true);
    fog.set_noise(false);
    command = accepted<SetFog>(decodeBinary(message));
    EXPECT_EQ(command.height_falloff, 0.5);
    EXPECT_EQ(command.base_height_m, -2);
    EXPECT_EQ(command.anisotropy, 0.75);
    EXPECT_EQ(command.albedo, glm::dvec3(1, 0, 0.5));
    EXPECT_EQ(command.tile_px, 8U);
    EXPECT_EQ(command.slice_count, 128U);
    EXPECT_EQ(command.half_rate, true);
    EXPECT_EQ(command.noise, false);
}

TEST(DecodeCommand, SetShadows_IsTakenInPartsAndNotEmpty) {
    v1::ClientMessage message = clientMessage();
    v1::SetShadows& set = *message.mutable_set_shadows();
    EXPECT_EQ(refused(decodeBinary(message)).message, "shadow_lights is missing");
    set.set_size(512);
    auto command = accepted<SetShadows>(decodeBinary(message));
    EXPECT_EQ(command.size_px, 512U);
    EXPECT_FALSE(command.lights);
    set.set_lights(32);
    command = accepted<SetShadows>(decodeBinary(message));
    EXPECT_EQ(command.lights, 32U);
    set.set_lights(33);
    EXPECT_EQ(refused(decodeBinary(message)).message,
              "shadow_lights is 33; it must be from 0 to 32");
}

TEST(DecodeCommand, SetToonOutline_IsTakenWithoutARamp) {
    v1::ClientMessage message = clientMessage();
    message.mutable_set_toon()->set_outline_strength(0.75);
    const auto command = accepted<SetToon>(decodeBinary(message));
    EXPECT_EQ(command.outline_strength, 0.75);
    EXPECT_FALSE(command.outline_width || command.fragment || command.compute);
}

} // namespace
} // namespace froxel::session
