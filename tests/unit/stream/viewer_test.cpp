#include "stream/viewer.h"

#include <gtest/gtest.h>

#include <memory>

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

} // namespace
} // namespace froxel::stream
