#include "interface/gbuffer_io.h"
#include "render/pipelines/gbuffer_layout.h"

#include <gtest/gtest.h>

namespace froxel::render {

namespace {

using settings::GbufferLayout;
using settings::NormalEncoding;
using settings::PositionSource;

} // namespace

// Each layout as it is, and what dielectrics reflect in the next whole word.
TEST(GbufferLayout, Specular_TakesAWordMore) {
    const auto bytes = [](NormalEncoding n, PositionSource p) {
        EXPECT_TRUE(holdsSpecular({n, p}));
        EXPECT_EQ(extraFormat(layoutFlags({n, p}) | io::kOutputSpecular),
                  extraFormat({n, p}, true));
        return gbufferBytesPerPixel({n, p}, false, true);
    };
    EXPECT_EQ(bytes(NormalEncoding::kOct16, PositionSource::kDepth), 8U + 4);
    EXPECT_EQ(bytes(NormalEncoding::kXyz16, PositionSource::kDepth), 8U + 8);
    EXPECT_EQ(bytes(NormalEncoding::kOct16, PositionSource::kStoredDepth), 8U + 8);
    EXPECT_EQ(bytes(NormalEncoding::kXyz16, PositionSource::kStoredDepth), 8U + 16);
    EXPECT_EQ(bytes(NormalEncoding::kXyz16, PositionSource::kFp16), 8U + 16);
    EXPECT_EQ(bytes(NormalEncoding::kOct16, PositionSource::kFp32), 8U + 16);
    EXPECT_FALSE(holdsSpecular({NormalEncoding::kXyz16, PositionSource::kFp32}));
}

TEST(GbufferLayout, Default_HasNoFlagsAndNoSecondTarget) {
    EXPECT_EQ(layoutFlags({}), 0U);
    EXPECT_EQ(extraFormat(GbufferLayout{}, false), vk::Format::eUndefined);
    EXPECT_EQ(gbufferBytesPerPixel({}, false, false), 8U);
    EXPECT_EQ(gbufferBytesPerPixel({}, true, false), 16U);
}

TEST(GbufferLayout, EveryLayout_GivesItsFormatFromItsFlags) {
    for (size_t n = 0; n < settings::kNormalEncodingNames.size(); ++n) {
        for (size_t p = 0; p < settings::kPositionSourceNames.size(); ++p) {
            const GbufferLayout layout{static_cast<NormalEncoding>(n),
                                       static_cast<PositionSource>(p)};
            EXPECT_EQ(extraFormat(layoutFlags(layout)), extraFormat(layout, false));
        }
    }
}

TEST(GbufferLayout, Bytes_AreThoseOfTheTable) {
    const auto bytes = [](NormalEncoding n, PositionSource p) {
        return gbufferBytesPerPixel({n, p}, false, false);
    };
    for (const auto n :
         {NormalEncoding::kOct16, NormalEncoding::kOct12, NormalEncoding::kOct10,
          NormalEncoding::kOct8, NormalEncoding::kXy16, NormalEncoding::kSpheremap16}) {
        EXPECT_EQ(bytes(n, PositionSource::kDepth), 8U);
        EXPECT_EQ(bytes(n, PositionSource::kStoredDepth), 12U);
        EXPECT_EQ(bytes(n, PositionSource::kFp16), 16U);
        EXPECT_EQ(bytes(n, PositionSource::kFp32), 24U);
    }
    EXPECT_EQ(bytes(NormalEncoding::kXyz16, PositionSource::kDepth), 10U);
    EXPECT_EQ(bytes(NormalEncoding::kXyz16, PositionSource::kStoredDepth), 16U);
    EXPECT_EQ(bytes(NormalEncoding::kXyz16, PositionSource::kFp16), 16U);
    EXPECT_EQ(bytes(NormalEncoding::kXyz16, PositionSource::kFp32), 24U);
}

} // namespace froxel::render
