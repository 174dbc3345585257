#include "stream/viewer.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

TEST(ViewerRefusals, ManyASecond_AreOneLineASecondThatCountsThem) {
    const session::SessionContext context;
    const TimePoint begin = TimePoint() + 1h;
    ViewerNews news;
    news.state = session::initialState(context, begin);
    Viewer viewer(news, nullptr);
    EXPECT_EQ(viewer.noteRefusal(begin), 1U);
    uint64_t told = 1;
    int lines = 1;
    for (int i = 1; i <= 1000; ++i) { // 200 a second
        if (const auto count = viewer.noteRefusal(begin + i * 5ms)) {
            ++lines;
            told += *count;
        }
    }
    EXPECT_EQ(lines, 6);
    EXPECT_EQ(told, 1001U);
}

// Of 2 x 1 pixels.
class ViewerSamples : public testing::Test {
  protected:
    ViewerSamples() {
        const session::SessionContext context;
        auto state = session::initialState(context, Clock::now());
        state.settings.size = {2, 1};
        ViewerNews news;
        news.state = state;
        viewer_ = std::make_unique<Viewer>(news, nullptr);
    }
    // As the device gives it back.
    bool add(uint32_t sample, std::byte grey, const session::SessionState& state) {
        pixels_.assign(8, grey);
        lease_ = PixelLease({pixels_.data(), 2, 1, 8}, [] {});
        BegunFrame frame{1, {}, state, Clock::now()};
        frame.sample = sample;
        frame.sample_count = 2;
        return viewer_->addSample(frame, lease_);
    }

    std::unique_ptr<Viewer> viewer_;
    std::vector<std::byte> pixels_;
    PixelLease lease_;
};

TEST_F(ViewerSamples, Samples_BecomeTheirMeanWithTheLast) {
    EXPECT_FALSE(add(0, std::byte{0}, viewer_->state));
    EXPECT_GT(viewer_->meanBytes(), 0U);
    EXPECT_TRUE(add(1, std::byte{255}, viewer_->state));
    EXPECT_EQ(lease_.view().data[0], std::byte{188}); // half of what white emits
    EXPECT_EQ(lease_.view().data[3], std::byte{255});
    EXPECT_EQ(viewer_->meanBytes(), 0U);
}

TEST_F(ViewerSamples, SampleOfWhatIsNoLongerAskedFor_IsNotKept) {
    const auto before = viewer_->state;
    ++viewer_->state.version;
    EXPECT_FALSE(add(0, std::byte{9}, before));
    EXPECT_EQ(viewer_->meanBytes(), 0U);
}

TEST_F(ViewerSamples, SampleAfterOneThatWasLost_IsNotKept) {
    EXPECT_FALSE(add(1, std::byte{9}, viewer_->state));
    EXPECT_EQ(viewer_->meanBytes(), 0U);
}

} // namespace
} // namespace froxel::stream
