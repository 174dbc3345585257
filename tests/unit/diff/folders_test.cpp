#include "diff/folders.h"
#include "support/temp_folder.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

namespace froxel::diff {
namespace {

namespace fs = std::filesystem;

class Folders : public testing::Test {
  protected:
    void add(const std::string& file) {
        const fs::path path = folder_.path() / file;
        fs::create_directories(path.parent_path());
        std::ofstream(path) << "x";
    }
    [[nodiscard]] fs::path path(const std::string& name) const { return folder_.path() / name; }

    test::TempFolder folder_{"froxel_diff"};
};

TEST_F(Folders, Pictures_ArePairedByTheirPaths) {
    for (const char* file : {"a/one.png", "a/deep/two.EXR", "a/three.jpg", "a/notes.txt",
                             "b/one.png", "b/deep/two.EXR", "b/four.pfm"}) {
        add(file);
    }
    const auto pairs = pairsOf(path("a"), path("b")).value();
    EXPECT_THAT(pairs.both, testing::ElementsAre("deep/two.EXR", "one.png"));
    EXPECT_THAT(pairs.only_picture, testing::ElementsAre("three.jpg"));
    EXPECT_THAT(pairs.only_reference, testing::ElementsAre("four.pfm"));
}

TEST_F(Folders, NothingToCompare_IsRefused) {
    add("a/notes.txt");
    add("b/notes.txt");
    const auto none = pairsOf(path("a"), path("b"));
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(none.error().message, testing::HasSubstr("have no pictures; expected .png"));
    const auto absent = pairsOf(path("a"), path("c"));
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().code, ErrorCode::kIo);
    EXPECT_THAT(absent.error().message, testing::HasSubstr("/c': No such file"));
}

} // namespace
} // namespace froxel::diff
