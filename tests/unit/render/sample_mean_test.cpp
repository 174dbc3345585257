#include "render/view/sample_mean.h"
#include "settings/samples.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace froxel::render {
namespace {

// Rows are longer than their pixels.
struct Sample {
    std::vector<std::byte> bytes;

    explicit Sample(const std::vector<uint8_t>& greys) {
        for (const uint8_t grey : greys) { // two rows of one pixel
            bytes.insert(bytes.end(),
                         {std::byte{grey}, std::byte{0}, std::byte{255}, std::byte{9}});
            bytes.insert(bytes.end(), 4, std::byte{77});
        }
    }
    [[nodiscard]] PixelView view() const { return {bytes.data(), 1, 2, 8}; }
};

TEST(SampleMean, EqualSamples_AreThatSample) {
    for (uint32_t grey = 0; grey < 256; ++grey) {
        SampleMean mean;
        const Sample sample({static_cast<uint8_t>(grey), 7});
        for (uint32_t i = 0; i < settings::kMeanSamples; ++i) {
            mean.add(sample.view());
        }
        EXPECT_EQ(mean.count(), settings::kMeanSamples);
        EXPECT_EQ(mean.memoryBytes(), SampleMean::memoryBytes({1, 2}));
        EXPECT_EQ(mean.take(),
                  (std::vector{std::byte(grey), std::byte{0}, std::byte{255}, std::byte{255},
                               std::byte{7}, std::byte{0}, std::byte{255}, std::byte{255}}));
    }
}

// Half of what white emits is 188, not 128.
TEST(SampleMean, BlackAndWhite_MeetInLinearLight) {
    SampleMean mean;
    mean.add(Sample({0, 255}).view());
    mean.add(Sample({255, 255}).view());
    const auto rgba8 = mean.take();
    EXPECT_EQ(rgba8[0], std::byte{188});
    EXPECT_EQ(rgba8[4], std::byte{255});
    EXPECT_EQ(mean.count(), 0U);
    EXPECT_EQ(mean.memoryBytes(), 0U);
}

TEST(Samples, Places_HaveASixteenthOfThePixelEach) {
    std::set<double> columns;
    std::set<double> rows;
    glm::dvec2 sum(0);
    for (uint32_t i = 0; i < settings::kMeanSamples; ++i) {
        const glm::dvec2 place = settings::samplePlace(i);
        columns.insert(std::floor((place.x + 0.5) * 16));
        rows.insert(std::floor((place.y + 0.5) * 16));
        sum += place;
    }
    EXPECT_EQ(columns.size(), 16U);
    EXPECT_EQ(rows.size(), 16U);
    EXPECT_NEAR(glm::length(sum), 0, 1e-12);
}

} // namespace
} // namespace froxel::render
