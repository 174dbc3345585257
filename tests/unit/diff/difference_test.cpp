#include "diff/difference.h"
#include "unit/diff/pictures.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace froxel::diff {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// One pixel of 12 is 10 steps lighter in one channel.
Difference onePixelOff(double tolerance = 0) {
    Picture picture = shown(4, 3, 100);
    std::get<ShownPicture>(picture).rgba8[4 * 6 + 1] = std::byte{110};
    return measure(picture, shown(4, 3, 100), tolerance).value();
}

TEST(Difference, EqualPictures_HaveNone) {
    const auto colours = measure(shown(5, 4, 7), shown(5, 4, 7)).value();
    EXPECT_TRUE(colours.equal());
    EXPECT_EQ(colours.flip, 0);
    EXPECT_EQ(wordsOf(colours), "equal, 20 pixels compared");
    EXPECT_THAT(broken(colours, {}), IsEmpty());
    const auto radiance = measure(light(5, 4, 7), light(5, 4, 7)).value();
    EXPECT_TRUE(radiance.equal());
    EXPECT_THAT(broken(radiance, {}), IsEmpty());
}

TEST(Difference, OnePixel_IsNamedAndMeasured) {
    const auto difference = onePixelOff();
    EXPECT_FALSE(difference.equal());
    EXPECT_EQ(difference.beyond.count, 1U);
    ASSERT_TRUE(difference.beyond.first);
    EXPECT_EQ(difference.beyond.first->x, 2U);
    EXPECT_EQ(difference.beyond.first->y, 1U);
    EXPECT_NEAR(difference.values.max_abs, 10 / 255.0, 1e-6);
    EXPECT_NEAR(difference.values.rmse, 10 / 255.0 / 6, 1e-6); // of 36 values
    EXPECT_EQ(difference.flip_errors.values.size(), 12U);
    EXPECT_THAT(wordsOf(difference),
                HasSubstr("1 of 12 pixels differ, by at most 10/255; the first "
                          "is (2, 1): 100 110 100 instead of 100 100 100"));
}

TEST(Difference, WithoutALimit_EveryPixelCounts) {
    EXPECT_THAT(broken(onePixelOff(), {}),
                ElementsAre("the share of pixels that differ is 0.0833, at most 0 is allowed"));
}

TEST(Difference, EachLimit_BreaksBelowItsFigure) {
    const auto difference = onePixelOff();
    EXPECT_THAT(broken(difference, {.max_flip = difference.flip}), IsEmpty());
    EXPECT_THAT(broken(difference, {.max_flip = difference.flip * 0.99}),
                ElementsAre(HasSubstr("FLIP is ")));
    EXPECT_THAT(broken(difference, {.max_rmse = 0.0066}), IsEmpty());
    EXPECT_THAT(broken(difference, {.max_rmse = 0.0065}),
                ElementsAre("RMSE is 0.00654, at most 0.0065 is allowed"));
    EXPECT_THAT(broken(difference, {.max_differing = 0.0834}), IsEmpty());
    EXPECT_THAT(broken(difference, {.max_differing = 0.0833}), testing::SizeIs(1));
    EXPECT_THAT(broken(difference, {.max_flip = 0, .max_rmse = 0, .max_differing = 0}),
                testing::SizeIs(3));
}

TEST(Difference, Tolerance_LeavesOutWhatIsWithinIt) {
    EXPECT_EQ(onePixelOff(9).beyond.count, 1U);
    EXPECT_EQ(onePixelOff(10).beyond.count, 0U);
    EXPECT_THAT(broken(onePixelOff(10), {.tolerance = 10}), IsEmpty());
    const auto radiance = [](double tolerance) {
        return measure(light(2, 2, 1.5F), light(2, 2, 1), tolerance).value().beyond.count;
    };
    EXPECT_EQ(radiance(0.4), 4U);
    EXPECT_EQ(radiance(0.5), 0U);
}

TEST(Difference, ValuesThatAreNotFinite_BreakEveryLimit) {
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        LinearImage picture = light(3, 3, 1);
        picture.rgb[3] = value;
        for (const LinearImage& reference : {light(3, 3, 1), picture}) {
            const auto difference = measure(picture, reference).value();
            EXPECT_FALSE(difference.equal());
            EXPECT_TRUE(std::isnan(difference.flip));
            EXPECT_THAT(difference.flip_errors.values, IsEmpty());
            EXPECT_THAT(broken(difference, {.max_flip = 1, .max_differing = 1}),
                        ElementsAre("1 of 9 pixels are not finite in one of the pictures"));
            EXPECT_THAT(wordsOf(difference), HasSubstr("1 are not finite"));
            EXPECT_EQ(shownOf(picture, reference).size(), 36U);
        }
    }
}

TEST(Difference, OtherSizesAndKinds_AreRefusedInWords) {
    EXPECT_EQ(measure(shown(2, 3, 0), shown(3, 2, 0)).error().message,
              "the pictures have 2x3 and 3x2 pixels; expected one size");
    EXPECT_EQ(measure(shown(2, 3, 0), light(2, 3, 0)).error().message,
              "the pictures hold display colours and linear radiance; expected the same of both");
}

// A picture twice as bright is as far from the reference as HDR-FLIP says, whatever the unit.
TEST(Difference, Radiance_IsShownByTheReferencesExposure) {
    const auto dim = shownOf(light(2, 2, 1), light(2, 2, 1));
    const auto bright = shownOf(light(2, 2, 1000), light(2, 2, 1000));
    EXPECT_EQ(dim, bright);
    EXPECT_GT(std::to_integer<int>(dim[0]), 150);
    EXPECT_NEAR(measure(light(2, 2, 2), light(2, 2, 1)).value().flip,
                measure(light(2, 2, 2000), light(2, 2, 1000)).value().flip, 1e-5);
}

} // namespace
} // namespace froxel::diff
