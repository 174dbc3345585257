#include "compare/clipped.h"

#include <gtest/gtest.h>

#include <vector>

namespace froxel::test {
namespace {

// A row of pixels, 0xRRGGBB each.
class Row {
  public:
    explicit Row(const std::vector<uint32_t>& colors) {
        for (const uint32_t color : colors) {
            for (const uint32_t byte : {color >> 16, color >> 8, color, 255U}) {
                bytes_.push_back(static_cast<std::byte>(byte & 255U));
            }
        }
    }
    [[nodiscard]] PixelView view() const {
        return {bytes_.data(), static_cast<uint32_t>(bytes_.size() / 4), 1, bytes_.size()};
    }

  private:
    std::vector<std::byte> bytes_;
};

TEST(Clipped, Surfaces_BlackOrWithAChannelAtItsEnd_AreCounted) {
    const Row picture({0x000000, 0xffffff, 0xffffff, 0xff0000, 0x000001, 0x808080});
    const Row depth({0x440154, 0x440154, 0x440154, 0x440154, 0x440154, 0x440154});
    const Clipped clipped = countClipped(picture.view(), depth.view());
    EXPECT_EQ(clipped.surface_count, 6U);
    EXPECT_EQ(clipped.black_count, 1U);
    EXPECT_EQ(clipped.blown_count, 3U);
}

TEST(Clipped, PixelsWithoutSurface_DoNotCount) {
    const Row picture({0x000000, 0xffffff, 0x000000});
    const Row depth({0x202020, 0x202020, 0xfde725});
    const Clipped clipped = countClipped(picture.view(), depth.view());
    EXPECT_EQ(clipped.surface_count, 1U);
    EXPECT_EQ(clipped.black_count, 1U);
    EXPECT_EQ(clipped.blown_count, 0U);
}

} // namespace
} // namespace froxel::test
