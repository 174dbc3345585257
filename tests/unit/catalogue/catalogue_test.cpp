#include "catalogue/catalogue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>

namespace froxel::catalogue {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class CatalogueTest : public testing::Test {
  protected:
    CatalogueTest() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~CatalogueTest() override { fs::remove_all(folder_); }

    fs::path write(const fs::path& path, const std::string& text = "x") {
        fs::create_directories((folder_ / path).parent_path());
        std::ofstream(folder_ / path) << text;
        return folder_ / path;
    }
    static std::vector<std::string> paths(const Catalogue& catalogue) {
        std::vector<std::string> found;
        for (const Offered& scene : catalogue.listing()->scenes()) {
            found.push_back(scene.path);
        }
        return found;
    }

    const fs::path folder_ = fs::path(testing::TempDir()) / "froxel_catalogue_test";
};

TEST_F(CatalogueTest, SceneFilesBelowTheFolder_AreOfferedByPath) {
    write("b/Fox.glb", "12345");
    write("a.gltf");
    write("A.GLB");
    write("a.bin");
    write("a.gltf.txt");
    const Catalogue catalogue({}, folder_);
    ASSERT_THAT(paths(catalogue), ElementsAre("A.GLB", "a.gltf", "b/Fox.glb"));
    const Offered fox = catalogue.listing()->scenes()[2];
    EXPECT_EQ(fox.name, "Fox");
    EXPECT_EQ(fox.bytes, 5U);
    EXPECT_EQ(fs::path(fox.source), fs::canonical(folder_ / "b/Fox.glb"));
    EXPECT_EQ(catalogue.find(fox.id)->path, "b/Fox.glb");
    EXPECT_FALSE(catalogue.find("fox"));
}

TEST_F(CatalogueTest, WhatIsHiddenOrLeadsOutOfTheFolder_IsNotOffered) {
    write(".hidden.glb");
    write(".git/scene.glb");
    const fs::path outside = fs::path(testing::TempDir()) / "froxel_catalogue_outside.glb";
    std::ofstream(outside) << "x";
    fs::create_symlink(outside, folder_ / "link.glb");
    fs::create_directory_symlink(folder_, folder_ / "circle");
    write("scene.glb");
    fs::create_symlink(folder_ / "scene.glb", folder_ / "also.glb");
    const Catalogue catalogue({}, folder_);
    fs::remove(outside);
    for (const Offered& scene : catalogue.listing()->scenes()) {
        EXPECT_EQ(scene.path, "scene.glb");
    }
    EXPECT_EQ(catalogue.listing()->scenes().size(), 1U);
}

TEST_F(CatalogueTest, FoldersDeeperThanTheLimit_AreNotEntered) {
    fs::path deep;
    for (int i = 0; i <= Catalogue::kDeepest; ++i) {
        write(deep / "scene.glb");
        deep /= "d";
    }
    write(deep / "scene.glb");
    EXPECT_EQ(Catalogue({}, folder_).listing()->scenes().size(), Catalogue::kDeepest + 1U);
}

TEST_F(CatalogueTest, Rescan_FindsWhatIsNewChangedAndGone) {
    const fs::path stays = write("stays.glb");
    const fs::path goes = write("goes.glb");
    Catalogue catalogue({}, folder_);
    const auto before = catalogue.listing();
    catalogue.rescan();
    EXPECT_EQ(catalogue.listing()->generation(), before->generation());

    fs::remove(goes);
    write("new.glb");
    fs::last_write_time(stays, fs::last_write_time(stays) + std::chrono::seconds(5));
    catalogue.rescan();
    EXPECT_GT(catalogue.listing()->generation(), before->generation());
    EXPECT_THAT(paths(catalogue), ElementsAre("new.glb", "stays.glb"));
    const Offered old = before->scenes()[1];
    ASSERT_EQ(old.path, "stays.glb");
    const auto now = catalogue.find(old.id);
    ASSERT_TRUE(now);
    EXPECT_NE(now->version, old.version);
}

TEST_F(CatalogueTest, WhatIsOfferedAnyway_ComesFirstAndOnce) {
    const fs::path first = write("z/first.glb");
    write("a.glb");
    const auto offered = offerFile(first, folder_);
    ASSERT_TRUE(offered);
    EXPECT_EQ(offered->path, "z/first.glb");
    const Catalogue catalogue({*offered, {"builtin", "hall", "", "builtin", 0, 0}}, folder_);
    EXPECT_THAT(paths(catalogue), ElementsAre("z/first.glb", "", "a.glb"));
}

TEST_F(CatalogueTest, FileOutsideTheFolder_IsOfferedByItself) {
    const fs::path file = write("models/Fox.glb");
    const auto offered = offerFile(file, folder_ / "other");
    ASSERT_TRUE(offered);
    EXPECT_EQ(offered->path, "");
    EXPECT_EQ(offered->name, "Fox");
    EXPECT_FALSE(offerFile(folder_ / "none.glb", folder_));
}

TEST_F(CatalogueTest, FolderThatIsGone_OffersNothingMore) {
    write("a.glb");
    Catalogue catalogue({}, folder_);
    fs::remove_all(folder_);
    catalogue.rescan();
    EXPECT_THAT(paths(catalogue), IsEmpty());
}

} // namespace
} // namespace froxel::catalogue
