// --environment-file.
#include "app/environment_file.h"
#include "environment/surroundings.h"
#include "unit/app/parsed_options.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <gmock/gmock.h>

namespace froxel::app {
namespace {

using testing::HasSubstr;

class EnvironmentFile : public testing::Test {
  protected:
    std::string write(const std::string& bytes) const {
        std::ofstream(path_, std::ios::binary) << bytes;
        return path_;
    }
    // Two texels of radiance 1 and 2, grey.
    std::string writeTwoTexels() const {
        return write("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                     "\x80\x80\x80\x81\x80\x80\x80\x82");
    }
    // Tests run side by side.
    const std::string path_ = testing::TempDir() + "environment_" +
                              testing::UnitTest::GetInstance()->current_test_info()->name() +
                              ".hdr";
};

TEST_F(EnvironmentFile, OfEveryCommandThatDraws_IsTaken) {
    EXPECT_EQ(parseRender({"--environment-file", "a.hdr"}).environment_file, "a.hdr");
    EXPECT_EQ(std::get<ServeOptions>(parse({"serve", "--environment-file", "a.hdr"}).command)
                  .environment_file,
              "a.hdr");
    EXPECT_EQ(std::get<BenchOptions>(
                  parse({"bench", "--out", "a.json", "--environment-file", "a.hdr"}).command)
                  .environment_file,
              "a.hdr");
    EXPECT_EQ(std::get<InfoOptions>(parse({"info", "--environment-file", "a.hdr"}).command)
                  .environment_file,
              "a.hdr");
}

TEST_F(EnvironmentFile, Report_HasSizeMeanAndMost) {
    const auto panorama = readPanorama(writeTwoTexels());
    ASSERT_TRUE(panorama) << panorama.error().message;
    const auto report = environmentReport(*panorama);
    EXPECT_EQ(report["size_px"], nlohmann::json({2, 1}));
    EXPECT_NEAR(report["mean_radiance"][1].get<double>(), 1.5, 1e-6);
    EXPECT_EQ(report["most_radiance"], 2.0);
}

TEST_F(EnvironmentFile, Scene_GetsItsLight) {
    scene::Scene scene;
    surround(scene, readSurroundings({}));
    EXPECT_EQ(scene.surroundings, nullptr);
    surround(scene, readSurroundings(writeTwoTexels()));
    ASSERT_NE(scene.surroundings, nullptr);
    EXPECT_NEAR(scene.surroundings->mean().y, 1.5, 1e-6);
}

TEST_F(EnvironmentFile, Bad_IsRefusedWithItsName) {
    const auto missing = readPanorama("no.hdr");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::kIo);
    EXPECT_THAT(missing.error().message, HasSubstr("cannot read 'no.hdr': No such file"));
    const auto nonsense = readPanorama(write("nonsense"));
    ASSERT_FALSE(nonsense);
    EXPECT_THAT(nonsense.error().message, HasSubstr("environment file '" + path_ + "' "));
    EXPECT_THAT(refusal({"serve", "--environment", "file"}), HasSubstr("--environment-file FILE"));
}

} // namespace
} // namespace froxel::app
