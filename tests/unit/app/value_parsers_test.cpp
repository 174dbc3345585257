#include "app/value_parsers.h"

#include <gtest/gtest.h>

#include <array>
#include <gmock/gmock.h>
#include <string>
#include <string_view>

namespace froxel::app {
namespace {

using testing::HasSubstr;

template <class T>
void expectRefused(const Result<T>& result, std::string_view text, std::string_view wanted) {
    ASSERT_TRUE(result.has_error()) << "'" << text << "' was accepted";
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(result.error().message, HasSubstr("'" + std::string(text) + "'"));
    EXPECT_THAT(result.error().message, HasSubstr(std::string(wanted)));
}

TEST(ParseNumber, WholeInRange_Accepted) {
    EXPECT_EQ(parseNumber("0", settings::kLightCountRange).value(), 0U);
    EXPECT_EQ(parseNumber("100000", settings::kLightCountRange).value(), 100'000U);
}

TEST(ParseNumber, RealInRange_Accepted) {
    EXPECT_EQ(parseNumber("0.001", settings::kLightRadiusRange).value(), 0.001);
    EXPECT_EQ(parseNumber("1e4", settings::kLightRadiusRange).value(), 1e4);
}

class BadWhole : public testing::TestWithParam<std::string_view> {};

TEST_P(BadWhole, Parsed_RefusedWithRange) {
    expectRefused(parseNumber(GetParam(), settings::kLightCountRange), GetParam(),
                  "a whole number from 0 to 1000000");
}

INSTANTIATE_TEST_SUITE_P(ParseNumber,
                         BadWhole,
                         testing::Values("",
                                         " 1",
                                         "1 ",
                                         "-1",
                                         "+1",
                                         "1000001",
                                         "1.5",
                                         "1e3",
                                         "0x10",
                                         "99999999999999999999",
                                         "ten"));

class BadReal : public testing::TestWithParam<std::string_view> {};

TEST_P(BadReal, Parsed_RefusedWithRange) {
    expectRefused(parseNumber(GetParam(), settings::kLightRadiusRange), GetParam(),
                  "a number from 0.001 to 10000");
}

INSTANTIATE_TEST_SUITE_P(
    ParseNumber,
    BadReal,
    testing::Values("", "nan", "NaN", "inf", "-inf", "0", "10000.5", "1e999", "2m", "1,5", "-2"));

TEST(ParseName, Known_GivesItsPosition) {
    for (size_t i = 0; i < settings::kRendererNames.size(); ++i) {
        EXPECT_EQ(parseName(settings::kRendererNames[i], settings::kRendererNames).value(), i);
    }
}

TEST(ParseName, Unknown_RefusedWithAllNames) {
    expectRefused(parseName("Naive", settings::kRendererNames), "Naive",
                  "naive, forward_plus, clustered_deferred, toon_fragment or toon_compute");
}

TEST(ParseSize, Edges_Accepted) {
    EXPECT_EQ(parseSize("16x4096").value(), (settings::Size{16, 4096}));
    EXPECT_EQ(parseSize("1281x719").value(), (settings::Size{1281, 719}));
}

class BadSize : public testing::TestWithParam<std::string_view> {};

TEST_P(BadSize, Parsed_RefusedWithRange) {
    expectRefused(parseSize(GetParam()), GetParam(), "from 16x16 to 4096x4096");
}

INSTANTIATE_TEST_SUITE_P(ParseSize,
                         BadSize,
                         testing::Values("",
                                         "x",
                                         "1280",
                                         "1280x",
                                         "x720",
                                         "15x720",
                                         "1280x4097",
                                         "1280x720x",
                                         "1280x720x1",
                                         "1280X720",
                                         "1280 x 720",
                                         "-1280x720"));

TEST(ParseGrid, SeedGrids_Accepted) {
    EXPECT_EQ(parseGrid("16x16x24").value(), (settings::GridSize{16, 16, 24}));
    EXPECT_EQ(parseGrid("32x16x64").value(), (settings::GridSize{32, 16, 64}));
}

TEST(ParseGrid, OutOfRange_RefusedWithRange) {
    for (const char* text : {"0x9x24", "16x129x24", "16x9x257", "16x9", "16x9x24x1", "axbxc"}) {
        expectRefused(parseGrid(text), text, "from 1x1x1 to 128x128x256");
    }
}

TEST(ParseGridChoice, AutoOrASize_KeepsTheLaw) {
    const settings::Grid before{.automatic = true, .size = {}, .law = settings::GridLaw::kLinear};
    const settings::Grid sized = parseGridChoice("3x4x5", before).value();
    EXPECT_EQ(sized, (settings::Grid{false, {3, 4, 5}, settings::GridLaw::kLinear}));
    EXPECT_EQ(parseGridChoice("auto", sized).value(),
              (settings::Grid{true, {3, 4, 5}, settings::GridLaw::kLinear}));
    expectRefused(parseGridChoice("automatic", before), "automatic", "auto or XxYxZ");
}

TEST(ParseLensShift, TwoNumbers_Accepted) {
    EXPECT_EQ(parseLensShift("-64,0.5").value(), glm::dvec2(-64, 0.5));
    for (const char* text : {"", "1", "1,", "1,2,3", "nan,0", "0,64.1", "0;0"}) {
        expectRefused(parseLensShift(text), text, "from -64 to 64");
    }
}

TEST(ParseBox, TwoCorners_Accepted) {
    const auto box = parseBox("-10,0,-5;10,8,5").value();
    EXPECT_EQ(box.min, glm::dvec3(-10, 0, -5));
    EXPECT_EQ(box.max, glm::dvec3(10, 8, 5));
}

TEST(ParseBox, Malformed_RefusedWithExample) {
    for (const char* text :
         {"", ";", "-10,0,-5", "-10,0,-5;10,8", "-10,0,-5;10,8,5;", "-10,0,-5;10,8,5,1",
          "-10,0,-5;10,0,5", // no height
          "10,8,5;-10,0,-5", // corners the wrong way round
          "-10,0,nan;10,8,5", "-10,0,-5;10,8,2e7"}) {
        expectRefused(parseBox(text), text, "\"-10,0,-5;10,8,5\"");
    }
}

TEST(ParseCamera, Numbers_GiveThatCamera) {
    const auto camera = std::get<settings::Camera>(parseCamera("-7,2,0;0,2,0;45").value());
    EXPECT_EQ(camera.eye_world, glm::dvec3(-7, 2, 0));
    EXPECT_DOUBLE_EQ(camera.focus_m, 7);
    EXPECT_DOUBLE_EQ(camera.yfov_rad, glm::radians(45.0));
    EXPECT_EQ(camera.world_from_view[1], glm::dvec3(0, 1, 0));
}

TEST(ParseCamera, NoSemicolon_IsAName) {
    EXPECT_EQ(std::get<std::string>(parseCamera("Along the nave").value()), "Along the nave");
}

TEST(ParseCamera, Malformed_RefusedWithExample) {
    for (const char* text : {"", "-7,2,0;0,2,0", "-7,2,0;0,2,0;", "-7,2,0;0,2,0;45;1",
                             "-7,2,0;0,2,0;45deg", "-7,2,0;0,2,0;0.5", "-7,2,0;0,2,0;171",
                             "-7,2,0;-7,2,0;45", // looks at itself
                             "-7,2;0,2,0;45", "-7,inf,0;0,2,0;45"}) {
        expectRefused(parseCamera(text), text, "\"-7,2,0;0,2,0;45\"");
    }
}

TEST(Parsers, ControlCharacters_AreEscapedInTheMessage) {
    const auto message = parseSize("1\n\x1b[31m").error().message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_THAT(message, HasSubstr("1\\x0a\\x1b[31m"));
}

} // namespace
} // namespace froxel::app
