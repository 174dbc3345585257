// Which variants a bounded cache keeps.
#include "render/pipelines/variant_cache.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <vector>

namespace froxel::render {
namespace {

using ::testing::ElementsAre;

struct FakeTimeline {
    uint64_t submitted = 0;
    uint64_t done = 0;
    [[nodiscard]] uint64_t next() const { return submitted + 1; }
    [[nodiscard]] uint64_t completed() const { return done; }
};

class VariantCacheTest : public ::testing::Test {
  protected:
    // A frame that uses these variants, submitted and not finished.
    void frame(const std::vector<int>& keys) {
        for (const int key : keys) {
            EXPECT_EQ(cache.findOrMake(key,
                                       [&] {
                                           ++made;
                                           return 10 * key;
                                       }),
                      10 * key);
        }
        ++timeline.submitted;
    }
    void finish() { timeline.done = timeline.submitted; }
    [[nodiscard]] std::vector<int> kept() const {
        std::vector<int> keys;
        cache.forEachKey([&](int key) { keys.push_back(key); });
        return keys;
    }

    FakeTimeline timeline;
    VariantMaker maker;
    VariantCache<int, int, FakeTimeline> cache{timeline, maker, 3};
    int made = 0;
};

TEST_F(VariantCacheTest, UsedAgain_IsMadeOnce) {
    frame({1, 2});
    frame({2, 1});
    EXPECT_EQ(made, 2);
}

TEST_F(VariantCacheTest, PastTheLimit_TheOneNotUsedForLongestGoes) {
    frame({1});
    frame({2});
    frame({3});
    frame({1});
    finish();
    frame({4});
    EXPECT_THAT(kept(), ElementsAre(1, 3, 4));
    frame({2});
    EXPECT_EQ(made, 5);
    EXPECT_THAT(kept(), ElementsAre(1, 2, 4));
}

TEST_F(VariantCacheTest, FrameNotFinished_KeepsWhatItUses) {
    frame({1, 2, 3});
    frame({4, 5});
    EXPECT_THAT(kept(), ElementsAre(1, 2, 3, 4, 5));
    finish();
    frame({6});
    EXPECT_THAT(kept(), ::testing::SizeIs(3));
    EXPECT_THAT(kept(), ::testing::Contains(6));
}

// A frame in pieces: the first runs, and others' frames after it, before its last is submitted.
TEST_F(VariantCacheTest, FrameWhosePiecesWait_KeepsWhatItUses) {
    maker.beginRecording();
    frame({1, 2, 3});
    VariantUses uses = maker.endRecording(timeline.done + 1);
    finish();
    frame({4, 5, 6, 7});
    finish();
    frame({8});
    EXPECT_THAT(kept(), ::testing::IsSupersetOf({1, 2, 3}));
    uses.end();
    finish();
    frame({9});
    EXPECT_THAT(kept(), ::testing::SizeIs(3));
}

TEST_F(VariantCacheTest, FrameThatNeedsMoreThanTheLimit_IsMadeOnceAndStays) {
    frame({1, 2, 3, 4, 5});
    finish();
    frame({1, 2, 3, 4, 5});
    finish();
    EXPECT_EQ(made, 5);
}

} // namespace
} // namespace froxel::render
