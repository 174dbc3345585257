#include "catalogue/folder_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>

namespace froxel::catalogue {
namespace {

namespace fs = std::filesystem;

constexpr Seconds kRest{0.05};

class FolderWatchTest : public testing::Test {
  protected:
    FolderWatchTest() {
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "sub");
    }
    ~FolderWatchTest() override { fs::remove_all(folder_); }
    void write(const fs::path& path) { std::ofstream(folder_ / path) << "x"; }
    // Whether there are more than `before` within 10 s.
    bool hears(int before) const {
        const auto end = Clock::now() + std::chrono::seconds(10);
        while (told_ <= before && Clock::now() < end) {
            std::this_thread::yield();
        }
        return told_ > before;
    }

    const fs::path folder_ = fs::path(testing::TempDir()) / "froxel_folder_watch_test";
    std::atomic<int> told_ = 0;
};

TEST_F(FolderWatchTest, NewChangedAndGoneFiles_AreHeardOf) {
    const FolderWatch watch(folder_, 8, kRest, [this] { return ++told_ > 0; });
    write("a.glb");
    ASSERT_TRUE(hears(0));
    int before = told_;
    write("a.glb");
    ASSERT_TRUE(hears(before));
    before = told_;
    fs::rename(folder_ / "a.glb", folder_ / "sub" / "b.glb");
    ASSERT_TRUE(hears(before));
    before = told_;
    fs::remove(folder_ / "sub" / "b.glb");
    EXPECT_TRUE(hears(before));
}

TEST_F(FolderWatchTest, NewFolder_IsWatchedToo) {
    const FolderWatch watch(folder_, 8, kRest, [this] { return ++told_ > 0; });
    fs::create_directories(folder_ / "new" / "below");
    ASSERT_TRUE(hears(0));
    const int before = told_;
    write("new/below/a.glb");
    EXPECT_TRUE(hears(before));
}

TEST_F(FolderWatchTest, FileThatIsWritten_IsToldOfWhenItRests) {
    std::atomic<bool> written = false;
    std::atomic<bool> early = false;
    const FolderWatch watch(folder_, 8, Seconds(0.5), [&] {
        early = early || !written;
        return ++told_ > 0;
    });
    Seconds longest{0}; // between two writes: a busy machine may rest longer than the watch waits
    {
        std::ofstream file(folder_ / "a.glb");
        const auto end = Clock::now() + std::chrono::milliseconds(200);
        for (auto before = Clock::now(); before < end;) {
            file << 'x' << std::flush;
            std::this_thread::yield();
            const auto now = Clock::now();
            longest = std::max<Seconds>(longest, now - std::exchange(before, now));
        }
        written = true;
    }
    ASSERT_TRUE(hears(0));
    EXPECT_TRUE(!early || longest > Seconds(0.4));
}

TEST_F(FolderWatchTest, FolderThatIsNotThere_IsNoTrouble) {
    const FolderWatch watch(folder_ / "none", 8, kRest, [this] { return ++told_ > 0; });
    EXPECT_EQ(told_, 0);
}

TEST_F(FolderWatchTest, FolderIsMovedAwayAndMadeAgain_TheNewOneIsWatched) {
    const FolderWatch watch(folder_, 8, kRest, [this] { return ++told_ > 0; });
    const fs::path aside = folder_.string() + "_aside";
    fs::remove_all(aside);
    fs::rename(folder_, aside);
    ASSERT_TRUE(hears(0));
    int before = told_;
    fs::create_directories(folder_);
    ASSERT_TRUE(hears(before));
    before = told_;
    write("a.glb");
    EXPECT_TRUE(hears(before));
    fs::remove_all(aside);
}

TEST_F(FolderWatchTest, LinkOnTheWayLeadsElsewhere_TheNewFolderIsWatched) {
    fs::create_directories(folder_ / "one/models");
    fs::create_directories(folder_ / "two/models");
    fs::create_directory_symlink("one", folder_ / "current");
    const FolderWatch watch(folder_ / "current/models", 8, kRest, [this] { return ++told_ > 0; });
    fs::create_directory_symlink("two", folder_ / "next");
    fs::rename(folder_ / "next", folder_ / "current");
    ASSERT_TRUE(hears(0));
    const int before = told_;
    write("two/models/a.glb");
    EXPECT_TRUE(hears(before));
}

TEST_F(FolderWatchTest, RightsOfAFileChange_IsHeardOf) {
    write("a.glb");
    const FolderWatch watch(folder_, 8, kRest, [this] { return ++told_ > 0; });
    fs::permissions(folder_ / "a.glb", fs::perms::owner_read);
    EXPECT_TRUE(hears(0));
}

TEST_F(FolderWatchTest, NotAllCouldBeLookedAt_IsToldAgainUntilItCould) {
    FolderWatch watch(folder_, 8, kRest, [this] { return ++told_ > 1; });
    watch.lookAgain();
    EXPECT_TRUE(hears(1)) << "nothing has changed";
}

} // namespace
} // namespace froxel::catalogue
