#include "catalogue/catalogue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <string>
#include <sys/resource.h>
#include <system_error>

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

    std::error_code failed_;
    const fs::path folder_ = fs::path(testing::TempDir()) / "froxel_catalogue_test";
};

TEST_F(CatalogueTest, SceneFilesBelowTheFolder_AreOfferedByPath) {
    write("b/Fox.glb", "12345");
    write("a.gltf");
    write("A.GLB");
    write("avatar.vrm");
    write("a.bin");
    write("a.gltf.txt");
    const Catalogue catalogue({}, folder_);
    ASSERT_THAT(paths(catalogue), ElementsAre("A.GLB", "a.gltf", "avatar.vrm", "b/Fox.glb"));
    const Offered fox = catalogue.listing()->scenes()[3];
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
    const Catalogue catalogue({}, folder_);
    fs::remove(outside);
    EXPECT_THAT(paths(catalogue), ElementsAre("scene.glb"));
}

// As Kubernetes mounts a ConfigMap: an update moves a link, and with it where all links lead.
TEST_F(CatalogueTest, FileOfALink_KeepsItsPathAndId_AndIsAnotherVersionWhereItLeadsElsewhere) {
    write("..first/a.glb");
    write("..second/a.glb");
    fs::create_directory_symlink("..first", folder_ / "..data");
    fs::create_symlink("..data/a.glb", folder_ / "a.glb");
    Catalogue catalogue({}, folder_);
    ASSERT_THAT(paths(catalogue), ElementsAre("a.glb"));
    const Offered before = catalogue.listing()->scenes()[0];
    EXPECT_EQ(before.name, "a");
    EXPECT_EQ(fs::path(before.source), fs::canonical(folder_ / "..first/a.glb"));

    fs::create_directory_symlink("..second", folder_ / "..new");
    fs::rename(folder_ / "..new", folder_ / "..data");
    EXPECT_TRUE(catalogue.rescan());
    ASSERT_THAT(paths(catalogue), ElementsAre("a.glb"));
    const Offered after = catalogue.listing()->scenes()[0];
    EXPECT_EQ(after.id, before.id);
    EXPECT_NE(after.version, before.version);
    EXPECT_EQ(fs::path(after.source), fs::canonical(folder_ / "..second/a.glb"));
}

TEST_F(CatalogueTest, FileThatReadingItOpened_ItsChangeIsAnotherVersion) {
    const fs::path scene = write("a.gltf");
    const fs::path texture = write("a.png", "one");
    const fs::path missing = folder_ / "b.png";
    Catalogue catalogue({}, folder_);
    const auto version = [&] { return catalogue.listing()->scenes()[0].version; };
    const std::string id = catalogue.listing()->scenes()[0].id;
    const auto read = [&] {
        catalogue.noteRead(
            id, version(),
            {{scene, stampOf(scene)}, {texture, stampOf(texture)}, {missing, stampOf(missing)}});
    };
    read();
    uint64_t before = version();
    catalogue.rescan();
    EXPECT_EQ(version(), before);
    // Of the same size, and of the same time.
    const auto time = fs::last_write_time(texture);
    fs::remove(texture);
    write("a.png", "two");
    fs::last_write_time(texture, time);
    catalogue.rescan();
    EXPECT_NE(version(), before);
    read();
    before = version();
    write("b.png");
    catalogue.rescan();
    EXPECT_NE(version(), before) << "it was not there when the scene was read";
    catalogue.noteRead(id, version(), {{scene, stampOf(scene)}, {texture, 1}});
    EXPECT_NE(version(), before + 1) << "it changed while the scene was read";
    before = version();
    catalogue.noteRead(id, before - 1, {{texture, 1}});
    EXPECT_EQ(version(), before) << "that version is listed no more";
}

TEST_F(CatalogueTest, RunsCountFromOtherVersions) {
    write("a.glb");
    EXPECT_NE(Catalogue({}, folder_).listing()->scenes()[0].version,
              Catalogue({}, folder_).listing()->scenes()[0].version)
        << "what it refers to may have changed between them";
}

// Whoever serves many connections runs out of descriptors.
TEST_F(CatalogueTest, FolderCannotBeReadForAWhile_WhatWasThereStays) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "UBSan looks at memory through descriptors, and there are none here";
#endif
    write("a.glb");
    write("sub/b.glb");
    Catalogue catalogue({}, folder_);
    write("c.glb");
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
    const rlimit none{0, limit.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
    const bool complete = catalogue.rescan();
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
    EXPECT_FALSE(complete);
    EXPECT_THAT(paths(catalogue), ElementsAre("a.glb", "sub/b.glb"));
    EXPECT_TRUE(catalogue.rescan());
    EXPECT_THAT(paths(catalogue), ElementsAre("a.glb", "c.glb", "sub/b.glb"));
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
    const auto offered = offerFile(first, folder_, failed_);
    ASSERT_TRUE(offered);
    EXPECT_EQ(offered->path, "z/first.glb");
    const Catalogue catalogue({*offered, {"builtin", "hall", "", "builtin", 0, 0}}, folder_);
    EXPECT_THAT(paths(catalogue), ElementsAre("z/first.glb", "", "a.glb"));
}

TEST_F(CatalogueTest, WhatIsOfferedAnyway_IsAnotherVersionWhenItChanges) {
    const fs::path first = write("first.glb");
    const auto offered = offerFile(first, folder_ / "other", failed_);
    ASSERT_TRUE(offered);
    Catalogue catalogue({*offered}, folder_ / "other");
    const uint64_t before = catalogue.listing()->scenes()[0].version;
    write("first.glb", "longer");
    catalogue.rescan();
    EXPECT_NE(catalogue.listing()->scenes()[0].version, before);
    EXPECT_EQ(catalogue.listing()->scenes()[0].bytes, 6U);
    fs::remove(first);
    catalogue.rescan();
    EXPECT_EQ(catalogue.listing()->scenes().size(), 1U);
}

TEST_F(CatalogueTest, FileOutsideTheFolder_IsOfferedByItself) {
    const fs::path file = write("models/Fox.glb");
    const auto offered = offerFile(file, folder_ / "other", failed_);
    ASSERT_TRUE(offered);
    EXPECT_EQ(offered->path, "");
    EXPECT_EQ(offered->name, "Fox");
    EXPECT_FALSE(offerFile(folder_ / "none.glb", folder_, failed_));
    EXPECT_EQ(failed_, std::errc::no_such_file_or_directory);
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
