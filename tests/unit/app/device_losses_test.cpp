#include "app/device_losses.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdlib.h>
#include <string>

namespace froxel::app {
namespace {

namespace fs = std::filesystem;

class DeviceLossesTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "froxel_losses_XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path folder_;
};

TEST_F(DeviceLossesTest, NextRun_KnowsOfThem) {
    EXPECT_EQ(DeviceLosses(folder_ / "new").count(), 0U);
    for (uint64_t run = 1; run <= 3; ++run) {
        DeviceLosses(folder_ / "new").add();
        EXPECT_EQ(DeviceLosses(folder_ / "new").count(), run);
    }
}

TEST_F(DeviceLossesTest, FileOfSomethingElse_CountsAsNone) {
    std::ofstream(folder_ / "device_losses") << "many";
    EXPECT_EQ(DeviceLosses(folder_).count(), 0U);
}

TEST_F(DeviceLossesTest, WithoutAFolder_ThisRunsCount) {
    DeviceLosses losses{fs::path()};
    losses.add();
    EXPECT_EQ(losses.count(), 1U);
}

} // namespace
} // namespace froxel::app
