#include "net/static_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <initializer_list>
#include <utility>

namespace froxel::net {
namespace {

namespace fs = std::filesystem;

class StaticFilesTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = fs::path(testing::TempDir()) / (std::string("froxel_static_") + test->name());
        fs::remove_all(root_);
        fs::create_directories(root_ / "assets");
    }
    void TearDown() override { fs::remove_all(root_); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(root_ / name) << text;
    }

    fs::path root_;
};

TEST_F(StaticFilesTest, Load_Folder_HasEveryFileUnderItsPath) {
    write("index.html", "page");
    write("favicon.svg", "<svg/>");
    write("assets/worker-12.js", "work");
    const auto files = StaticFiles::load(root_).value();
    EXPECT_EQ(files.count(), 3U);
    EXPECT_EQ(files.find("/")->plain.body, "page");
    EXPECT_EQ(files.find("/index.html")->content_type, "text/html; charset=utf-8");
    EXPECT_FALSE(files.find("/index.html")->immutable);
    EXPECT_EQ(files.find("/favicon.svg")->content_type, "image/svg+xml");
    EXPECT_TRUE(files.find("/assets/worker-12.js")->immutable);
    EXPECT_EQ(files.find("/assets"), nullptr);
}

// As a ConfigMap is mounted.
TEST_F(StaticFilesTest, Load_LinksToFilesInTheFolder_AreServed_AndThoseThatLeadOutAreNot) {
    fs::create_directories(root_ / "..2026_11");
    write("..2026_11/index.html", "page");
    fs::create_directory_symlink("..2026_11", root_ / "..data");
    fs::create_symlink("..data/index.html", root_ / "index.html");
    const fs::path outside = root_.string() + "_outside.txt";
    std::ofstream(outside) << "secret";
    fs::create_symlink(outside, root_ / "outside.txt");
    fs::create_symlink("nothing", root_ / "broken.txt");
    const auto files = StaticFiles::load(root_).value();
    fs::remove(outside);
    EXPECT_EQ(files.count(), 1U);
    EXPECT_EQ(files.find("/index.html")->plain.body, "page");
}

TEST_F(StaticFilesTest, Load_ChangedContent_ChangesTheETag) {
    write("index.html", "one");
    const std::string before = StaticFiles::load(root_).value().find("/")->plain.etag;
    EXPECT_EQ(StaticFiles::load(root_).value().find("/")->plain.etag, before);
    write("index.html", "two");
    EXPECT_NE(StaticFiles::load(root_).value().find("/")->plain.etag, before);
}

TEST_F(StaticFilesTest, Load_CodedFiles_AreRepresentationsAndNoFiles) {
    write("index.html", "page");
    write("index.html.gz", "zipped");
    write("index.html.br", "brotli");
    write("archive.gz", "a file of its own");
    const auto files = StaticFiles::load(root_).value();
    EXPECT_EQ(files.count(), 2U);
    EXPECT_EQ(files.find("/index.html.gz"), nullptr);
    EXPECT_EQ(files.find("/archive.gz")->plain.body, "a file of its own");
    const StaticFile& page = *files.find("/");
    for (const auto& [accepted, sent] : std::initializer_list<std::pair<const char*, const char*>>{
             {"", "page"},
             {"gzip", "zipped"},
             {"gzip, deflate, br", "brotli"},
             {"GZIP;q=1.0", "zipped"},
             {"gzip;q=0.2, br;q=0", "zipped"},
             {"gzip;q=0, br;q=0.000", "page"},
             {"*", "brotli"},
             {"br;q=0, *;q=0.5", "zipped"},
             {"identity, *;q=0", "page"},
             {"zstd, brotli, x-gzip", "page"},
             {"gzip;q=;,,;\x01", "zipped"}, // as far as it can be read
         }) {
        EXPECT_EQ(page.bestFor(accepted).body, sent) << accepted;
    }
    EXPECT_NE(page.bestFor("gzip").etag, page.bestFor("br").etag);
    EXPECT_NE(page.bestFor("gzip").etag, page.plain.etag);
}

TEST_F(StaticFilesTest, Load_Links_AreLeftOut) {
    write("index.html", "page");
    fs::create_symlink("/etc/hostname", root_ / "link.txt");
    fs::create_directory_symlink("/etc", root_ / "folder");
    EXPECT_EQ(StaticFiles::load(root_).value().count(), 1U);
}

TEST_F(StaticFilesTest, Load_NoIndex_IsAnErrorNamingTheFolder) {
    const auto files = StaticFiles::load(root_);
    ASSERT_FALSE(files);
    EXPECT_EQ(files.error().code, ErrorCode::kIo);
    EXPECT_NE(files.error().message.find(root_.string()), std::string::npos);
}

TEST_F(StaticFilesTest, Load_NoFolder_IsAnError) {
    EXPECT_FALSE(StaticFiles::load(root_ / "nowhere"));
}

TEST(StaticFiles, Find_NoPage_IsNull) {
    EXPECT_EQ(StaticFiles().find("/"), nullptr);
}

} // namespace
} // namespace froxel::net
